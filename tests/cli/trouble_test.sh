#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs the built program where something goes wrong around it: streams that cannot be written, a full disk, signals,
# two runs at once, a graphics device that fails in mid-frame. Every failure must end with status 1, one line on
# stderr, and no file.
# Usage: trouble_test.sh ESTAMPE MAKE_EXAMPLE LAYER_FOLDER     the folder of the layer that makes calls fail
set -euo pipefail
estampe="$(realpath "$1")"
make_example="$(realpath "$2")"
layer="$(realpath "$3")"
# shellcheck source=tests/support/harness.sh
source "$(dirname "${BASH_SOURCE[0]}")/../support/harness.sh"
trap 'rm -rf "$folder" "$folder".err' EXIT
cd "$folder"

# expect_files NAME...: nothing else lies in the folder, hidden or not
expect_files() {
    local wanted found
    wanted="$(printf '%s\n' "$@" | sort)"
    found="$(find . -mindepth 1 -printf '%P\n' | sort)"
    [[ "$found" == "$wanted" ]] || wrong "files: $(tr '\n' ' ' <<<"$found")instead of $*"
}

# expect_failure LABEL PATTERN COMMAND...: status 1, one line that matches, nothing new in the folder
expect_failure() {
    local label="$1" pattern="$2" status=0 before after
    shift 2
    before="$(ls -lAR --time-style=full-iso .)"
    "$@" >/dev/null 2>"$folder".err || status=$?
    after="$(ls -lAR --time-style=full-iso .)"
    [[ $status -eq 1 ]] || wrong "$label: status $status instead of 1"
    [[ "$(grep -cv '^estampe: note: ' "$folder".err)" -eq 1 ]] || wrong "$label: not one line: $(cat "$folder".err)"
    grep -q "^estampe: error: .*$pattern" "$folder".err || wrong "$label: no '$pattern' in: $(cat "$folder".err)"
    [[ "$before" == "$after" ]] || wrong "$label: changed files: $after"
}

"$make_example" scene.glb >/dev/null
small=(--size 96x54 --device cpu)

# Streams that are full or closed
status=0
"$estampe" info missing.glb 2>/dev/full || status=$?
[[ $status -eq 1 ]] || wrong "an error that cannot be said: status $status instead of 1"
"$estampe" render scene.glb -o a.png "${small[@]}" --time 2 2>/dev/full || wrong "a warning that cannot be said is a failure"
"$estampe" render scene.glb -o b.png "${small[@]}" --time 2 <&- >&- 2>&- || wrong "closed streams are a failure"
cmp a.png b.png || wrong "what belongs on a closed stream is in the picture"
rm a.png b.png
expect_files scene.glb

# A disk that is full, which a limit of sizes stands for; where the driver keeps memory in files, which that would hit
# too, a disk of one page
limited() { (
    ulimit -f 4
    "$@"
); }
tiny=(--set tam.size_px=64 --set tam.tones=4 --set tam.candidates=8)
room="$folder".room
mkdir "$room"
# fill_disk COMMAND...: what cannot be written in this folder by what the command runs
fill_disk() {
    expect_failure 'full disk' 'a.png: cannot write' "$@" "$estampe" render "$folder"/scene.glb -o a.png "${small[@]}"
    expect_failure 'full disk' 'a.tam: cannot write' "$@" "$estampe" tam -o a.tam "${tiny[@]}"
    expect_failure 'full disk' 'cannot write' "$@" "$estampe" tam -o painted/ "${tiny[@]}" --set tam.size_px=256
    for file in a.jpg a.webp a.exr a.ora; do
        expect_failure 'full disk' "$file: cannot write" "$@" "$estampe" render "$folder"/scene.glb -o "$file" --size 320x180 --device cpu
    done
    expect_failure 'full disk' 'cannot write' "$@" "$estampe" render "$folder"/scene.glb -o - "${small[@]}" --layers layers
}
if limited "$estampe" render scene.glb -o - "${small[@]}" 2>/dev/null | cat >/dev/null; then
    fill_disk limited
elif mount -t tmpfs -o size=4k,nr_inodes=50 tmpfs "$room"; then
    (
        cd "$room"
        fill_disk env
        expect_files
        [[ $failures -eq 0 ]]
    ) || failures=$((failures + 1))
    umount "$room"
else
    wrong "no disk can be made full: a limit of sizes hits the driver, and none can be mounted"
fi
# Of two files one cannot be: there is none then
nameless="$(printf 'x%.0s' {1..256})"
expect_failure 'one of two' 'name too long' "$estampe" render scene.glb -o a.png "${small[@]}" --motion "$nameless.exr"
expect_failure 'one of two' 'name too long' "$estampe" render scene.glb -o a.jpg "${small[@]}" --layers "$nameless"
expect_failure 'one of two' 'name too long' "$estampe" tam -o "$nameless.tam" "${tiny[@]}" --preview a.png
expect_files scene.glb

# A long name is no reason to fail as long as the disk takes it
long="$(printf 'x%.0s' {1..251}).dot"
"$estampe" graph scene.glb -o "$long" "${small[@]}" || wrong "a name of 255 bytes is too long"
rm -f "$long"

# A disk that is full, where one may be mounted
if mount -t tmpfs -o size=12k,nr_inodes=20 tmpfs "$room" 2>/dev/null; then
    (
        cd "$room"
        expect_failure 'no room' 'a.png: cannot write: No space left on device; make room' "$estampe" render "$folder"/scene.glb -o a.png --size 320x180 --device cpu
        expect_failure 'no room' 'a.svg: cannot write: No space left on device; make room' "$estampe" render "$folder"/scene.glb -o a.svg "${small[@]}"
        expect_failure 'no room' 'cannot write: No space left on device' "$estampe" tam -o painted/ "${tiny[@]}" --set tam.size_px=256
        expect_files
        [[ $failures -eq 0 ]]
    ) || failures=$((failures + 1))
    umount "$room"
fi
rmdir "$room"

# Signals: nothing half done is left, and a shell sees which one it was
for signal in INT TERM HUP; do
    status=0
    timeout --preserve-status -s "$signal" 2 "$estampe" render scene.glb -o a.png --device cpu --repeat 100000 2>/dev/null ||
        status=$?
    [[ $status -eq $((128 + $(kill -l "$signal"))) ]] || wrong "SIG$signal: status $status"
done
status=0
(
    trap '' HUP
    timeout -s HUP 2 "$estampe" render scene.glb -o a.png "${small[@]}"
) || status=$?
rm -f a.png
[[ $status -eq 0 || $status -eq 124 ]] || wrong "an ignored SIGHUP: status $status"
expect_files scene.glb

# Two runs at once: a whole picture of one of them
"$estampe" render scene.glb -o a.png "${small[@]}" &
"$estampe" render scene.glb -o a.png --size 97x55 --device cpu
wait $! || wrong "one of two runs at once failed"
"$estampe" render scene.glb -o b.png "${small[@]}"
"$estampe" render scene.glb -o c.png --size 97x55 --device cpu
cmp -s a.png b.png || cmp -s a.png c.png || wrong "two runs at once left half a picture"
rm a.png b.png c.png
expect_files scene.glb

# Threads that cannot be started
threads_from() {
    local first="$1"
    shift
    LD_PRELOAD="$layer"/libestampe_failing_calls.so ESTAMPE_FAIL_CALLS=thread:"$first":0 timeout 100 "$@"
}
if [[ -e "$layer"/libestampe_failing_calls.so ]]; then
    for first in 1 2 3 5; do
        expect_failure "no thread from $first on" 'threads, .* could be started: Resource temporarily unavailable' \
            threads_from "$first" "$estampe" render scene.glb -o a.png "${small[@]}"
    done
    for first in 1 2; do
        threads_from "$first" "$estampe" info scene.glb >/dev/null || wrong "a scene cannot be read without threads"
        threads_from "$first" "$estampe" tam -o a.tam "${tiny[@]}" || wrong "a map cannot be drawn without threads"
        rm -f a.tam
    done
    expect_files scene.glb
fi

# Less memory than is needed, which a limit of address space stands for
starved() { (
    ulimit -v "$1"
    shift
    "$@"
); }
if [[ -e "$layer"/libestampe_failing_calls.so ]]; then # a sanitizer takes terabytes of address space
    printf 'glTF\002\000\000\000\000\000\000\300\000\000\000\001JSON' >vast.glb # a sound header that promises 3 GiB
    truncate -s 3G vast.glb
    expect_failure 'a vast file' 'vast.glb: reading it needs 3.0 GiB of memory, [0-9.]* [GM]iB are free' \
        starved 2000000 "$estampe" info vast.glb
    rm vast.glb
fi

# No driver, and devices that fail
no_driver=(env VK_DRIVER_FILES=/nonexistent VK_ICD_FILENAMES=/nonexistent)
expect_failure 'no driver' 'install mesa' "${no_driver[@]}" "$estampe" render scene.glb -o a.png
expect_failure 'no driver' 'install mesa' "${no_driver[@]}" "$estampe" devices
failing() {
    local what="$1"
    shift
    VK_LAYER_PATH="$layer" VK_INSTANCE_LAYERS=VK_LAYER_ESTAMPE_failing ESTAMPE_FAIL="$what" "$@"
}
while read -r what pattern; do
    expect_failure "$what" "$pattern" failing "$what" "$estampe" render scene.glb -o a.png "${small[@]}" --motion a.exr
done <<'CALLS'
vkCreateInstance:1:-1 out of graphics memory
vkCreateDevice:1:-3 Vulkan failed with code -3; choose another --device
vkAllocateMemory:1:-2 out of graphics memory; try a smaller --size
vkAllocateMemory:3:-2 out of graphics memory; try a smaller --size
vkMapMemory:2:-5 vkMapMemory: Vulkan failed with code -5
vkCreateImage:5:-2 out of graphics memory
vkCreateBuffer:20:-1 out of graphics memory
vkAllocateDescriptorSets:2:-1000069000 code -1000069000
vkQueueSubmit2:1:-4 the graphics device was lost; try again
vkQueueSubmit2:2:-4 the graphics device was lost; try again
vkWaitForFences:2:-4 the graphics device was lost
vkGetQueryPoolResults:1:-4 the graphics device was lost
CALLS
expect_failure 'strokes of a lost device' 'was lost' failing vkQueueSubmit2:2:-4 "$estampe" render scene.glb -o a.svg "${small[@]}"
expect_failure 'graph of a lost device' 'was lost' failing vkQueueSubmit2:2:-4 "$estampe" graph scene.glb -o a.dot "${small[@]}"
expect_files scene.glb

# A device that is lost in mid-film: the film goes on with another, and its frames are the same, also after --resume
film=("$estampe" render scene.glb --turntable --frames 4 --size 64x48 --device cpu --style flowing-ink --set smoke.enabled=true)
mkdir whole lost
"${film[@]}" -o whole/%d.png 2>said || wrong "a film fails: $(cat said)"
ESTAMPE_COUNT_CALLS=calls failing none:1:0 "${film[@]}" -o whole/%d.png 2>said
calls="$(sed -n 's/^vulkan-main //p' calls)"
for part in 3 5 7 9; do
    failing "main:$((calls * part / 10)):-4" "${film[@]}" -o lost/%d.png 2>said || wrong "the film ends with its device: $(cat said)"
    [[ $(grep -c '^estampe: warning: the graphics device was lost in frame [1-4]; the film goes on with another$' said) -eq 1 ]] ||
        wrong "part $part: no word on it: $(cat said)"
    diff -r whole lost || wrong "part $part: a film after a lost device is another"
done
"${film[@]}" -o lost/%d.png 2>said &
while [[ ! -e lost/2.png || lost/2.png -ot said ]] && kill -0 $! 2>/dev/null; do sleep 0.01; done
pkill -INT -P $! 2>/dev/null || kill -INT $! 2>/dev/null || true
wait $! || true
failing "main:$((calls / 4)):-4" "${film[@]}" -o lost/%d.png --resume 2>said || wrong "a resumed film ends with its device: $(cat said)"
diff -r whole lost || wrong "a resumed film after a lost device is another"
# It goes on three times for one frame; then it fails.
status=0
failing vkQueueSubmit2:1:-4:1000 "${film[@]}" -o lost/%d.png 2>said || status=$?
[[ $status -eq 1 && $(grep -c '^estampe: error: .*was lost' said) -eq 1 ]] || wrong "a device lost again and again: $status, $(cat said)"
rm -r whole lost said calls
# The next job of a batch has another device
printf '[[job]]\nscene = "scene.glb"\noutput = "{n}.png"\nstyle = ["comic", "pencil"]\nsize = "64x48"\n' >jobs.toml
status=0
failing vkQueueSubmit2:9:-4 "$estampe" batch jobs.toml --device cpu 2>said || status=$?
[[ $status -eq 1 && -e 2.png && ! -e 1.png ]] || wrong "a job of a lost device spoils the next: $status, $(cat said)"
rm -f jobs.toml jobs.report.json said 1.png 2.png
expect_files scene.glb

[[ $failures -eq 0 ]] || exit 1
echo "All is as it should be."
