#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# script/test asks for warnings as errors where it is told to, tells which suites took longest, and ends as ctest did. CMake and
# CTest are stand-ins. Usage: script_test.sh ESTAMPE_FOLDER
set -euo pipefail
root="$1"
# shellcheck source=tests/support/harness.sh
source "$(dirname "${BASH_SOURCE[0]}")/../support/harness.sh"

mkdir -p "$folder"/{bin,script,build/test}
cp "$root/script/test" "$folder/script"
printf '#!/bin/sh\n' >"$folder/script/bootstrap"
cat >"$folder/bin/cmake" <<'EOF'
#!/bin/sh
echo "cmake $*"
EOF
cat >"$folder/bin/ctest" <<'EOF'
#!/bin/bash
echo "ctest $*"
while [[ $# -gt 0 && $1 != --output-junit ]]; do shift; done
{
    echo '<testsuite name="(empty)" tests="12" time="99.5">'
    for suite in 1 2 3 4 5 6 7 8 9 10 11; do
        printf '\t<testcase name="Suite%s" classname="Suite%s" time="%s.25" status="run">\n' $suite $suite $suite
    done
    printf '\t<testcase name="Soon" classname="Soon" time="1.2e-05" status="run">\n'
} >"$2"
exit "$ENDS"
EOF
chmod +x "$folder"/{bin,script}/*

# run STATUS [OPTION...]: what script/test says, where ctest ends so
run() {
    local status=0
    PATH="$folder/bin:$PATH" ENDS="$1" "$folder/script/test" "${@:2}" >"$folder/said" || status=$?
    [[ $status -eq $1 ]] || wrong "ends with $status where ctest ends with $1"
}
unset ESTAMPE_WERROR
run 0
! grep -q WERROR "$folder/said" || wrong "warnings are errors: $(cat "$folder/said")"
run 8 -L unit
grep -q '^ctest .* -L unit$' "$folder/said" || wrong "options do not reach ctest: $(cat "$folder/said")"
[[ "$(awk 'told { print $2 } /slowest/ { told = 1 }' "$folder/said" | paste -sd ' ')" == \
    "Suite11 Suite10 Suite9 Suite8 Suite7 Suite6 Suite5 Suite4 Suite3 Suite2" ]] ||
    wrong "the slowest are not told: $(cat "$folder/said")"
ESTAMPE_WERROR=ON run 0
grep -q '^cmake --preset test .*-DESTAMPE_WERROR=ON' "$folder/said" || wrong "warnings are none: $(cat "$folder/said")"
[[ $failures -eq 0 ]]
