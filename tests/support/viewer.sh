# shellcheck shell=bash disable=SC2154 # folder and estampe are the test's
# SPDX-License-Identifier: MIT
# A window of the viewer on a virtual display, for tests that play the person before it. To be sourced after harness.sh,
# in the folder of the test, with `estampe` set.
viewer=
size=640x400 # of the window

# shellcheck disable=SC2317 # the trap calls it
clean_up() {
    [[ -z $viewer ]] || kill "$viewer" 2>/dev/null || true
    kill "$server" 2>/dev/null || true
    rm -rf "$folder"
}

exec 3>display
Xvfb -displayfd 3 -screen 0 1000x700x24 -nolisten tcp 2>/dev/null &
server=$!
trap clean_up EXIT
until [[ -s display ]]; do sleep 0.02; done
DISPLAY=":$(tr -d '\n' <display)"
export DISPLAY

seen=0
# await PATTERN: until the viewer says it, after what was awaited before
await() {
    local line end=$((SECONDS + 40))
    while ((SECONDS < end)); do
        line="$(tail -n +$((seen + 1)) log | grep -n -m 1 -- "$1" || true)"
        if [[ -n $line ]]; then
            seen=$((seen + ${line%%:*}))
            return
        fi
        kill -0 "$viewer" 2>/dev/null || break
        sleep 0.02
    done
    wrong "'$1' does not come after line $seen: $(tail -5 log)"
}
# skip: what comes from now on is awaited
skip() { seen="$(wc -l <log)"; }

# open_viewer ARGUMENT...: opens a window of $size and waits for its picture
open_viewer() {
    : >log
    seen=0
    "$estampe" view --size "$size" --device cpu --verbose "$@" >printed 2>log &
    viewer=$!
    await 'refined'
    window="$(xdotool search --onlyvisible --name Estampe | head -1)"
    xdotool windowfocus --sync "$window"
}
# close_viewer: by its key; it ends well and in silence
close_viewer() {
    xdotool key q
    status=0
    wait "$viewer" || status=$?
    viewer=
    [[ $status -eq 0 ]] || wrong "closed with $status: $(tail -3 log)"
    [[ ! -s printed ]] || wrong "printed: $(head -5 printed)"
}

# shot NAME: what the window shows, once it has stood for two looks
shot() {
    local last='' now
    for ((i = 0; i < 40; ++i)); do
        import -window "$window" "$1.png"
        now="$(identify -format '%#' "$1.png")"
        [[ $now != "$last" ]] || return 0
        last="$now"
        sleep 0.08
    done
}
# differing A B [GEOMETRY]: how many pixels differ
differing() {
    local area="${3:-640x366+0+0}"
    compare -metric AE \( "$1.png" -crop "$area" +repage \) \( "$2.png" -crop "$area" +repage \) null: 2>&1 || true
}
# same A B [GEOMETRY]: B, the last shot, is or soon becomes what A is
same() {
    for ((try = 0; try < 50; ++try)); do
        [[ "$(differing "$@")" -ne 0 ]] || return 0
        sleep 0.1
        shot "$2"
    done
    wrong "$1 and $2 are not the same: $(differing "$@") pixels"
}
others() { [[ "$(differing "$@")" -gt 2000 ]] || wrong "$1 and $2 are nearly the same: $(differing "$@") pixels"; }
# key NAME...: and the picture that comes of it
key_then_picture() {
    skip
    xdotool key "$1"
    await 'refined'
}
