#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs files of jobs, good and bad, and checks what is drawn, what the report says and what is left on disk.
# Usage: batch_test.sh ESTAMPE MAKE_EXAMPLE     the program, and the one that writes the example scene
set -euo pipefail
estampe="$(realpath "$1")"
make_example="$(realpath "$2")"
# shellcheck source=tests/support/harness.sh
source "$(dirname "${BASH_SOURCE[0]}")/../support/harness.sh"
cd "$folder"

# expect STATUS PATTERN ARGUMENT...: `estampe batch ARGUMENT...` ends with STATUS, and the last line of stderr matches
expect() {
    local wanted="$1" pattern="$2" status=0
    shift 2
    "$estampe" batch "$@" --device cpu >out 2>err || status=$?
    [[ $status -eq $wanted ]] || wrong "batch $*: status $status instead of $wanted: $(cat err)"
    [[ -z $pattern ]] || tail -1 err | grep -q -- "$pattern" || wrong "batch $*: no '$pattern' in: $(cat err)"
    [[ ! -s out ]] || wrong "batch $*: printed on stdout: $(cat out)"
    [[ -z "$(find . -name '.*.part-*')" ]] || wrong "batch $*: left $(find . -name '.*.part-*')"
}

# report FILE PATTERN: the report is whole and has a line that matches
report() {
    grep -q -- "$2" "$1" || wrong "no '$2' in $1: $(cat "$1")"
    [[ "$(tail -1 "$1")" == "}" ]] || wrong "$1 is not whole"
}

"$make_example" scene.glb >/dev/null
"$make_example" other.glb >/dev/null

# Each with each, one job as render draws it, and a failure that does not stop the rest
cat >jobs.toml <<'END'
[defaults]
size = "64x40"
set = ["drawing.seed=3"]

[[job]]
scene = ["scene.glb", "other.glb"]
style = ["comic+no-color", "pencil"]
output = "{scene}-{style}.png"

[[job]]
scene = "missing.glb"
output = "missing.png"

[[job]]
scene = "other.glb"
output = "lines.svg"
style = "manual"
plotter = true

[[job]]
scene = "scene.glb"
output = "page.jpg"
page = "20x30mm"
dpi = 72
landscape = true
END
expect 1 'jobs.toml: 1 of 7 jobs failed; jobs.report.json tells which' jobs.toml
for file in scene-comic+no-color.png scene-pencil.png other-comic+no-color.png other-pencil.png lines.svg page.jpg; do
    [[ -s $file ]] || wrong "no $file"
done
[[ ! -e missing.png ]] || wrong "a failed job left its file"
report jobs.report.json '"done": 6'
report jobs.report.json '"failed": 1'
report jobs.report.json '"error": "missing.glb: '
report jobs.report.json '"place": "jobs.toml:10:1"'
grep -q 'warning: job 5: missing.glb: ' err || wrong "the failure is not told: $(cat err)"
"$estampe" render other.glb -o alone.png --size 64x40 --style pencil --set drawing.seed=3 --device cpu
cmp alone.png other-pencil.png || wrong "a job is not the picture that render draws"

# Transparent paper, with a mode and without
cat >clear.toml <<'END'
[defaults]
scene = "other.glb"
size = "64x40"

[[job]]
output = "clear.png"
transparent = true

[[job]]
output = "ink.png"
transparent = "paper"

[[job]]
output = "clear.jpg"
transparent = true
END
expect 1 'clear.toml: 1 of 3 jobs failed' clear.toml
grep -q 'JPEG has no alpha channel' err || wrong "a transparent JPEG is not told: $(cat err)"
"$estampe" render other.glb -o clear-alone.png --size 64x40 --transparent --device cpu
cmp clear-alone.png clear.png || wrong "a transparent job is not the picture that render draws"
"$estampe" render other.glb -o ink-alone.png --size 64x40 --transparent=paper --device cpu
cmp ink-alone.png ink.png || wrong "a job of transparent paper is not the picture that render draws"

# Films are what render draws, and so are the pictures after them; the program's own world is known by its seed
cat >films.toml <<'END'
[defaults]
scene = "scene.glb"
size = "64x40"

[[job]]
output = "turn%d.png"
style = "pencil"
turntable = true
frames = "2"

[[job]]
output = "turn.gif"
turntable = true
frames = "1-3"
fps = 12

[[job]]
output = "after.png"
style = "pencil"
END
expect 0 '' films.toml
"$estampe" render scene.glb -o 'alone%d.png' --size 64x40 --style pencil --turntable --frames 2 --device cpu 2>/dev/null
for i in 1 2; do cmp "alone$i.png" "turn$i.png" || wrong "frame $i is not the one that render draws"; done
[[ "$(identify turn.gif | wc -l)" -eq 3 ]] || wrong "turn.gif has not three frames"
"$estampe" render scene.glb -o alone.png --size 64x40 --style pencil --device cpu
cmp alone.png after.png || wrong "a film changes the picture after it"
rm -f -- alone*.png

# Sides of which a list is drawn each; a job's own view takes the place of the camera that all have. The axis that points up
# is another scene
cat >sides.toml <<'END'
[defaults]
scene = "scene.glb"
size = "64x40"
camera = "auto"

[[job]]
view = ["front", "top"]
ortho = true
output = "side-{view}.png"

[[job]]
view = "front"
ortho = true
up = "z"
output = "side-turned.png"
END
expect 0 '' sides.toml
"$estampe" render scene.glb -o alone.png --size 64x40 --view top --ortho --device cpu
cmp alone.png side-top.png || wrong "a job's view is not the one that render draws"
! cmp -s side-front.png side-turned.png || wrong "the up axis of a job changes nothing"
rm -f -- alone.png side-*.png

# Shards: each job in one of them, whatever their number
rm -- *.png
sed -i 's/"missing.glb"/"scene.glb"/' jobs.toml
for i in 1 2 3; do
    expect 0 '' jobs.toml --shard "$i/3"
    report "jobs.$i-of-3.report.json" '"failed": 0'
done
[[ "$(cat jobs.?-of-3.report.json | grep -c '"status": "done"')" -eq 7 ]] || wrong "shards are not all jobs"
[[ "$(cat jobs.?-of-3.report.json | grep '"output"' | sort -u | wc -l)" -eq 7 ]] || wrong "shards share jobs"
expect 0 '' jobs.toml --shard 1/99 --report none.json
report none.json '"jobs": \[\]'

# Mistakes: nothing is drawn, and no report is written
rm -f -- *.png *.json
bad() {
    printf '%b' "$2" >bad.toml
    expect 1 "$1" bad.toml
    [[ ! -e bad.report.json ]] || wrong "a report of: $2"
}
bad 'bad.toml:3:1: unknown key "stile"; did you mean "style"?' '[[job]]\nscene = "scene.glb"\nstile = "comic"\n'
bad 'bad.toml:1:1: this job has no "output"' '[[job]]\nscene = "scene.glb"\n'
bad 'bad.toml:1:1: unknown table "jobs"' '[[jobs]]\nscene = "scene.glb"\n'
bad 'bad.toml: holds no job' '[defaults]\nsize = "64x40"\n'
bad 'bad.toml:1:1: jobs 1 and 2 both write a.png' '[[job]]\nscene = "scene.glb"\nstyle = ["comic", "wash"]\noutput = "a.png"\n'
bad 'bad.toml:1:7: not TOML' '[[job]\n'
bad 'bad.toml:2:9: a date or time is no word' '[[job]]\nscene = 2020-01-01\n'
bad 'bad.toml:2:1: "size" takes no list' '[[job]]\nsize = ["1x1"]\n'
words="$(seq -s ', ' 1001 | sed 's/[0-9]\+/"&"/g')"
printf '[[job]]\nscene = "scene.glb"\noutput = "{n}.png"\ncamera = [%s]\nstyle = [%s]\n' "$words" "$words" >many.toml
expect 1 'many.toml:1:1: stands for more than 1000000 pictures' many.toml
expect 2 'shard.* write 1/4' jobs.toml --shard 4/3
expect 1 'nowhere.toml' nowhere.toml
[[ -z "$(ls ./*.png 2>/dev/null)" ]] || wrong "a mistake drew $(ls ./*.png)"

# A wrong option is the job's own failure
printf '[[job]]\nscene = "scene.glb"\noutput = "a.png"\nsize = "huge"\n\n[[job]]\nscene = "scene.glb"\noutput = "b.png"\nsize = "32x20"\n' >mixed.toml
expect 1 '1 of 2 jobs failed' mixed.toml
report mixed.report.json 'mixed.toml:1:1: --size: .*huge.* is not a size'
[[ -s b.png && ! -e a.png ]] || wrong "not b.png alone"

# Ctrl-C: the job in hand is finished, the report says what was not begun
{
    printf '[defaults]\nscene = "scene.glb"\nsize = "640x360"\nsamples = 4\n'
    for i in {1..40}; do printf '[[job]]\noutput = "stop{n}.png"\n'; done
} >stop.toml
"$estampe" batch stop.toml --device cpu >out 2>err &
pid=$!
for _ in {1..600}; do
    [[ -e stop1.png ]] && break
    sleep 0.05
done
kill -INT "$pid"
status=0
wait "$pid" || status=$?
[[ $status -eq 1 ]] || wrong "Ctrl-C: status $status: $(cat err)"
tail -1 err | grep -q 'stop.toml: stopped with [0-9]* of 40 jobs not begun' || wrong "Ctrl-C: $(cat err)"
report stop.report.json '"failed": 0'
done_count="$(grep -c '"status": "done"' stop.report.json)"
drawn_count="$(find . -name 'stop*.png' | wc -l)"
[[ $done_count -ge 1 && $done_count -lt 40 && $done_count -eq $drawn_count ]] ||
    wrong "Ctrl-C: $done_count done, $drawn_count drawn"
[[ -z "$(find . -name '.*.part-*')" ]] || wrong "Ctrl-C left $(find . -name '.*.part-*')"

[[ $failures -eq 0 ]] || exit 1
