#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# script/soak runs rounds until its time is over, ends at the first finding and says how to repeat it. CMake and the rounds
# are stand-ins. Usage: soak_test.sh ESTAMPE_FOLDER
set -euo pipefail
root="$1"
# shellcheck source=tests/support/harness.sh
source "$(dirname "${BASH_SOURCE[0]}")/../support/harness.sh"

mkdir -p "$folder"/{bin,script,tests/soak}
cp "$root/script/soak" "$folder/script"
printf '#!/bin/sh\necho "bootstrap $*"\n' >"$folder/script/bootstrap"
printf '#!/bin/sh\necho "cmake $*"\n' >"$folder/bin/cmake"
chmod +x "$folder"/{bin,script}/*
rounds=(films batches viewer memory faults)
for round in "${rounds[@]}"; do
    [[ -f "$root/tests/soak/$round.sh" ]] || wrong "there is no round $round"
    # shellcheck disable=SC2016 # the stand-in expands
    printf 'echo "$0 $*" >>"$ROUNDS"; sleep 0.3; [[ "$0" != *"${FINDING:-none}.sh" ]]\n' >"$folder/tests/soak/$round.sh"
done

# run STATUS ARGUMENT...: what script/soak says, and the rounds that it runs
run() {
    local wanted="$1" status=0
    shift
    : >"$folder/rounds"
    ROUNDS="$folder/rounds" PATH="$folder/bin:$PATH" "$folder/script/soak" "$@" >"$folder/said" 2>&1 || status=$?
    [[ $status -eq $wanted ]] || wrong "soak $*: status $status instead of $wanted: $(cat "$folder/said")"
}
run 0 0.001 7
grep -q '^cmake --build --preset test --target estampe ' "$folder/said" || wrong "builds nothing: $(cat "$folder/said")"
[[ "$(wc -l <"$folder/rounds")" -ge 6 ]] || wrong "3.6 s are few rounds: $(cat "$folder/rounds")"
for round in "${rounds[@]}"; do
    grep -q "$round.sh build/test [0-9]* [1-3]$" "$folder/rounds" || wrong "no round of $round: $(cat "$folder/rounds")"
done
tail -n 1 "$folder/said" | grep -q '^Nothing was found' || wrong "does not say so: $(cat "$folder/said")"
head -n 5 "$folder/rounds" | sed 's/ [0-9]*$//' >"$folder/first"
run 0 0.001 7
head -n 5 "$folder/rounds" | sed 's/ [0-9]*$//' | cmp -s - "$folder/first" || wrong "one seed gives other rounds"

FINDING=viewer run 1 1
repeat="$(sed -n 's|^FAILED: repeat it with: script/soak ||p' "$folder/said")"
[[ $repeat =~ ^--round\ viewer\ [0-9]+$ ]] || wrong "does not say how to repeat it: $(cat "$folder/said")"
[[ "$(tail -n 1 "$folder/rounds")" == "tests/soak/viewer.sh build/test ${repeat##* } "* ]] || wrong "another seed: $repeat"
# shellcheck disable=SC2086 # words
FINDING=viewer run 1 $repeat
[[ "$(cat "$folder/rounds")" == "tests/soak/viewer.sh build/test ${repeat##* } "* ]] || wrong "does not repeat it"
# shellcheck disable=SC2086
run 0 $repeat
for mistake in '' 'x' '-1' '1 x' '1 2 3' '--round' '--round none 1' '--round viewer' '--round viewer x'; do
    # shellcheck disable=SC2086
    run 1 $mistake
    grep -q '^Usage: script/soak HOURS' "$folder/said" || wrong "soak $mistake: no usage: $(cat "$folder/said")"
done
[[ $failures -eq 0 ]]
