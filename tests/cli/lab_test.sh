#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs the laboratory on good and bad input and checks exit status, messages and what is left on disk.
# Usage: lab_test.sh ESTAMPE_LAB
set -euo pipefail
lab="$(realpath "$1")"
# shellcheck source=tests/support/harness.sh
source "$(dirname "${BASH_SOURCE[0]}")/../support/harness.sh"
mkdir "$folder/work"
cd "$folder/work"

# expect_success ARGUMENT...: ends with 0 and says no error; stdout goes to ../out
expect_success() {
    "$lab" "$@" >../out 2>../err || wrong "estampe_lab $*: $(cat ../err)"
    ! grep -q error ../err || wrong "estampe_lab $*: $(cat ../err)"
}
# expect_printed PATTERN: the last success printed a line that matches
expect_printed() { grep -q -- "$1" ../out || wrong "no '$1' in: $(head -20 ../out)"; }
# expect_error STATUS PATTERN ARGUMENT...: ends with STATUS, says one line on stderr that matches PATTERN and nothing on
# stdout, and leaves the folder as it was.
expect_error() {
    local wanted="$1" pattern="$2" status=0 before
    shift 2
    before="$(ls -lAR --time-style=full-iso .)"
    "$lab" "$@" >../out 2>../err || status=$?
    [[ $status -eq $wanted ]] || wrong "estampe_lab $*: status $status instead of $wanted"
    [[ "$(wc -l <../err)" -eq 1 ]] || wrong "estampe_lab $*: not one line: $(cat ../err)"
    grep -q "^estampe_lab: error: .*$pattern" ../err || wrong "estampe_lab $*: no '$pattern' in: $(cat ../err)"
    [[ ! -s ../out ]] || wrong "estampe_lab $*: printed on stdout: $(cat ../out)"
    [[ "$before" == "$(ls -lAR --time-style=full-iso .)" ]] || wrong "estampe_lab $*: changed files"
}
small=(--frames 1 --size 64x36 --device cpu)

# Series
expect_success --help
expect_printed '^  triangles    A whole frame'
expect_success triangles lamps "${small[@]}" --most 0.02 --json series.json --csv series.csv --plots plots
expect_printed '^lamps, by lamps'
expect_printed '^ *10000 '
grep -q '^triangles,triangles,10000,' series.csv || wrong "series.csv lacks a row"
[[ "$(head -c 4 plots/lamps.svg)" == "<svg" ]] || wrong "plots/lamps.svg is no SVG"
expect_success --compare series.json series.json
expect_printed ' 1.000 '
expect_error 2 'no series .lumps.' lumps
expect_error 2 '--size' --size 64
expect_error 2 '--size' --size 0x36
expect_error 2 'is not a device' --device gpu
expect_error 2 '--raster' --raster soft
expect_error 2 '--frames' --frames 0
expect_error 2 'see estampe_lab --help' --no-such-option
expect_error 2 'must end in .json' --json series.txt
expect_error 2 'leave out series' lamps --compare series.json series.json
expect_error 2 '--most' --most 2
expect_error 2 '--plots' --plots ""
expect_error 1 'series.csv/plots' lamps --most 0.001 --plots series.csv/plots
expect_error 1 'no such folder' lamps --json nowhere/series.json
expect_error 1 'nothing.json' --compare series.json nothing.json
echo "{}" >empty.json
expect_error 1 "no result of estampe_lab" --compare series.json empty.json

# Lights
expect_success lights --counts 2,70 --shadowed 1 "${small[@]}" -o lights.svg
expect_printed '^ *70 '
[[ "$(head -c 4 lights.svg)" == "<svg" ]] || wrong "lights.svg is no SVG"
expect_success lights --counts 1 "${small[@]}" --json
expect_printed '"light_ms"'
expect_error 2 '--counts' lights --counts 0
expect_error 2 'must end in .svg' lights -o lights.png
expect_error 2 'see estampe_lab lights --help' lights --no-such-option

# Kernels
expect_success kernels min --rounds 1 --device cpu --json kernels.json --csv kernels.csv
expect_printed '^if (x > a) x = a '
grep -q '"against": "min(x, a)"' kernels.json || wrong "kernels.json does not say what is compared"
[[ "$(wc -l <kernels.csv)" == 5 ]] || wrong "kernels.csv has not a row for each kernel"
expect_error 2 'no experiment .lumps.' kernels lumps
expect_error 2 '--rounds' kernels --rounds 0

# Each pass against the device
expect_success roofline field "${small[@]}" --least 0 --no-cache --json roof.json --csv roof.csv
expect_printed 'GB/s'
expect_printed '^light'
grep -q '^field,"light' roof.csv || wrong "roof.csv lacks the light"
grep -q '"share_of_copy"' roof.json || wrong "roof.json lacks shares"
expect_error 2 'no picture .lumps.' roofline lumps
expect_error 2 '--least' roofline --least 1
[[ $failures -eq 0 ]]
