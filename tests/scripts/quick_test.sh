#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Each folder of src/ with tests that draw has one of them among the quick, and tests/quick_suites.txt names only suites
# that are. Usage: quick_test.sh ESTAMPE_FOLDER LIST...     lists are those that cmake/list_test_suites.cmake writes
set -euo pipefail
cd "$1"
shift
# shellcheck source=tests/support/harness.sh
source tests/support/harness.sh

sed -n 's/^add_test(\[=\[\([^]]*\)\]=\].*/\1/p' "$@" | sort >"$folder/suites"
twice="$(uniq -d "$folder/suites")" # of two suites of one name CTest runs one alone
[[ -z "$twice" ]] || wrong "suites of this name stand in two test programs: $twice"
grep -v '^#' tests/quick_suites.txt | sed 's/^-//' | sort >"$folder/named"
unknown="$(comm -13 "$folder/suites" "$folder/named")"
[[ -z "$unknown" ]] || wrong "tests/quick_suites.txt names what is no suite: $unknown"

sed -n 's/^set_tests_properties(\[=\[\([^]]*\)\]=\].*[[;]quick[];].*/\1/p' "$@" | sort -u >"$folder/quick"
# suites FOLDER: those that draw; what instances of one are named stands before or behind its name
suites() { find "$1" -name '*_gpu_test.cpp' -print0 | xargs -0 sed -nE 's/^(TYPED_)?TEST(_F|_P)?\((\w+),.*/\3/p' | sort -u; }
for place in src/*/ src/features/*/ src/techniques/*/; do
    suites "$place" >"$folder/of_place"
    [[ ! -s "$folder/of_place" ]] || grep -qEf <(sed 's/.*/(^|_)&(_|$)/' "$folder/of_place") "$folder/quick" ||
        wrong "nothing of $place is quick: $(paste -sd ' ' "$folder/of_place")"
done
[[ $failures -eq 0 ]]
