# Sourced by the window tests: starts a virtual display and the editor, and simulates user input.
# Expects BLUSH ASSETS as the first two arguments of the test.
set -u
blush=$1
assets=$2
test_name=$(basename "$0")
work=$(mktemp -d)
probe=$work/probe.json
export LIBGL_ALWAYS_SOFTWARE=1 XDG_CONFIG_HOME=$work/config XDG_STATE_HOME=$work/state XDG_PICTURES_DIR=$work BLUSH_ASSETS=$assets
export BLUSH_UI_PROBE=$probe BLUSH_UI_STATS=$work/stats.json BLUSH_UI_SIZE=900x560 BLUSH_UI_SCALE=1
unset OCIO WAYLAND_DISPLAY
export DBUS_SESSION_BUS_ADDRESS= # no desktop: the window asks for files itself
size=320x240
spp=16
screen=1280x800 # of the virtual display
settings= # JSON of what the window remembers; empty: it begins as if it were the first
rest="890 550" # where the mouse is out of the image's way: the end of the status bar
xvfb= editor=

finish() {
    [ -n "$editor" ] && kill "$editor" 2>/dev/null
    [ -n "$xvfb" ] && kill "$xvfb" 2>/dev/null
    wait 2>/dev/null
    rm -rf "$work"
}
trap finish EXIT

fail() {
    echo "$test_name: $1" >&2
    [ -f "$work/log" ] && sed 's/^/  blush: /' "$work/log" >&2
    [ -f "$probe" ] && head -n 1 "$probe" >&2
    exit 1
}

# until_true SECONDS COMMAND...: waits until the command succeeds.
until_true() {
    local end=$((SECONDS + $1))
    shift
    until "$@" 2>/dev/null; do
        [ $SECONDS -lt $end ] || return 1
        [ -z "$editor" ] || kill -0 "$editor" 2>/dev/null || return 1
        sleep 0.05
    done
}

start_display() {
    local tool
    for tool in Xvfb xdotool import compare; do command -v $tool >/dev/null || fail "$tool is not installed"; done
    exec 3<>"$work/display"
    Xvfb -displayfd 3 -screen 0 "$screen"x24 -nolisten tcp >/dev/null 2>&1 &
    xvfb=$!
    until_true 30 test -s "$work/display" || fail "Xvfb does not start"
    export DISPLAY=:$(head -n 1 "$work/display")
    cd "$work" || exit 1
}

overlays_off() { press h; }
# open_file FILE [unanswered]: waits until it has converged, overlays off; with a second argument, only until there is a window.
# With an empty FILE, none is given.
open_file() {
    rm -rf "$XDG_CONFIG_HOME"
    [ -z "$settings" ] || { mkdir -p "$XDG_CONFIG_HOME/blush" && echo "$settings" >"$XDG_CONFIG_HOME/blush/window.json"; }
    "$blush" ${1:+"$1"} --size $size --spp $spp >"$work/log" 2>&1 &
    editor=$!
    until_true 120 test -f "$probe" || fail "the window does not open"
    [ -z "${2:-}" ] || return 0
    until_true 120 converged || fail "the image does not converge"
    overlays_off
}
# open_editor SCENE: one of the shipped scenes.
open_editor() { open_file "$assets/scenes/$1.gltf"; }

gone() { ! kill -0 "$editor" 2>/dev/null; }
# leaves WHY_NOT COMMAND: repeats the command until the window is closed.
leaves() {
    local end=$((SECONDS + 60))
    until gone; do
        [ $SECONDS -lt $end ] || fail "$1"
        $2
        sleep 0.1
    done
    wait "$editor" || fail "the window ends with an error"
    editor=
    rm -f "$probe"
}
discard_if_asked() { ! has_widget "Dialog/Discard" || click "Dialog/Discard"; }
close_editor() {
    xdotool key ctrl+q
    leaves "Ctrl+Q does not close the window" discard_if_asked
}

# ---- input: each of these waits until the window has taken it up and has settled
taken() { [ "$(number 1 inputs)" -ge "$1" ]; }
# input COUNT COMMAND...: the command makes at least this many presses and releases of keys and buttons or turns of the wheel.
input() {
    local count=$1 before
    shift
    before=$(number 1 inputs)
    "$@"
    # A window that this closes takes up the rest of it no more.
    until_true 60 taken $((before + count)) || gone || fail "the window does not take up: $*"
}
mouse_is_at() { state mouse_x "$1" && state mouse_y "$2"; }
# point_at X Y: moves the mouse.
point_at() {
    local x=$(($1 > 0 ? $1 : 0)) y=$(($2 > 0 ? $2 : 0))
    xdotool mousemove "$x" "$y"
    until_true 60 mouse_is_at "$x" "$y" || fail "the mouse does not come to $x $y"
}
# click_here [BUTTON [XDOTOOL'S OPTIONS]]
click_here() { input 2 xdotool click "${@:2}" "${1:-1}"; }
hold_button() { input 1 xdotool mousedown 1; }
release_button() { input 1 xdotool mouseup 1; }
# press KEYS...: each with modifiers, such as ctrl+z.
press() {
    local keys="$*"
    input $(($(wc -w <<<"${keys//+/ }") * 2)) xdotool key "$@"
}
# As press, but held for longer than a frame on a busy machine: fields only see keys that are down at the start of a frame.
hold() {
    local count
    count=$(wc -w <<<"${1//+/ }")
    input "$count" xdotool keydown "$1"
    input "$count" xdotool keyup "$1"
}
# move_by DX DY: from where the mouse is.
move_by() { point_at $(($(number 1 mouse_x) + $1)) $(($(number 1 mouse_y) + $2)); }
typing() { state typing true; } # a text field has the keyboard
# double_click WIDGET: begins typing into a field.
double_click() {
    local field=$1
    # Between two late frames, clicks are lost. A third click within 0.3 s would not begin another double-click.
    started() { typing || { point_at $(middle "$field") && input 4 xdotool click --repeat 2 --delay 60 1 && { typing || sleep 0.4; } && typing; }; }
    until_true 30 has_widget "$1" || fail "there is no $1 to type into"
    until_true 30 started || fail "a double-click into $1 does not begin typing"
}
type_text() {
    local shifted=${1//[^A-Z_~:\"<>?+(){\}|!@#$%^&*]/}
    input $((2 * (${#1} + ${#shifted}))) xdotool type --delay 50 -- "$1"
}

# The probe's first line is the state, each further one a widget.
state() { head -n 1 "$probe" | grep -q "\"$1\":$2[,}]"; }
number() { sed -n "$1s/.*\"$2\":\\(-\\{0,1\\}[0-9.]*\\).*/\\1/p" "$probe"; }
widget() { grep -F "  \"$1\": {" "$probe"; }
field() { widget "$1" | sed "s/.*\"$2\":\\([0-9.]*\\).*/\\1/"; }
has_widget() { widget "$1" >/dev/null; }
says() { head -n 1 "$probe" | grep -qF "\"toast\":\"$1"; }
# The state is read once: between two reads the window may replace an image that is complete but outdated by one that is up to date
# but not complete.
shows_converged() { [[ $1 == *'"complete":true'[,}]* && $1 == *'"up_to_date":true'[,}]* ]]; }
converged() { shows_converged "$(head -n 1 "$probe")"; }
edited_since() {
    local line
    line=$(head -n 1 "$probe")
    [[ $line != *"\"revision\":$1"[,}]* ]] && shows_converged "$line"
}

# after_edit COMMAND...: runs a command that changes the image, and waits until the image has converged.
after_edit() {
    local revision
    revision=$(number 1 revision)
    "$@"
    until_true 120 edited_since "$revision" || fail "no new image converges after: $*"
}

# middle WIDGET [PER_CENT]: a point at this fraction of the widget's width, vertically centred.
middle() {
    echo "$(field "$1" x) $(field "$1" width) $(field "$1" y) $(field "$1" height) ${2:-50}" |
        awk '{ printf "%d %d", $1 + $2 * $5 / 100, $3 + $4 / 2 }'
}
# point_at_widget WIDGET [PER_CENT]: as middle. Panels and menus may still move until the mouse has come.
point_at_widget() {
    local at
    until_true 30 has_widget "$1" || fail "there is no $1 to point at"
    until
        at=$(middle "$@")
        point_at $at
        [ "$(middle "$@")" = "$at" ]
    do :; done
}
click() {
    point_at_widget "$1"
    click_here
}
# click_choice WIDGET NAME: selects an entry of a combo box.
click_choice() { click "$1" && click "$1/$2"; }
# click_menu MENU COMMAND
click_menu() { click "Menu bar/$1" && click "Menu/$2"; }
# drag_from X Y X Y
drag_from() {
    point_at "$1" "$2"
    hold_button
    point_at $((($1 + $3) / 2)) $((($2 + $4) / 2))
    point_at "$3" "$4"
    release_button
}
# drag WIDGET FROM TO, in per cent of its width.
drag() {
    until_true 30 has_widget "$1" || fail "there is no $1 to drag"
    drag_from $(middle "$1" "$2") $(middle "$1" "$3")
}
# drag_by WIDGET DX DY, in pixels.
drag_by() {
    until_true 30 has_widget "$1" || fail "there is no $1 to drag"
    local x y
    read -r x y <<<"$(middle "$1")"
    drag_from "$x" "$y" $((x + $2)) $((y + $3))
}

image_size() { sed -n "1s/.*\"image\":{[^}]*\"$1\":\([0-9.]*\).*/\1/p" "$probe"; }
image_middle() { echo "$(number 1 x) $(image_size width) $(number 1 y) $(image_size height)" | awk '{ printf "%d %d", $1 + $2 / 2, $3 + $4 / 2 }'; }
settled() { state settled true; }
# apart A B: two regions, each as "x y width height", share no pixel.
apart() { echo "$1 $2" | awk '{ exit !($1 >= $5 + $7 || $5 >= $1 + $3 || $2 >= $6 + $8 || $6 >= $2 + $4) }'; }
region_of() { echo "$(field "$1" x) $(field "$1" y) $(field "$1" width) $(field "$1" height)"; }
image() { echo "$(number 1 x) $(number 1 y) $(image_size width) $(image_size height)"; }
no_message_over_the_image() {
    local name
    for name in $(grep -o '"Card/[^"]*"' "$probe" | tr -d '"'); do apart "$(region_of "$name")" "$(image)" || return 1; done
}
# dismiss_messages: by a click on each; those with a button stay for a minute.
dismiss_messages() {
    dismissed() {
        ! has_widget Card/0 || { point_at $(middle Card/0 3) && click_here && ! has_widget Card/0; }
    }
    until_true 30 dismissed || fail "a click does not dismiss a message: $(widget Card/0)"
}
# Takes a screenshot of the image, with the mouse outside of it and without messages over it.
take_image() {
    point_at $rest
    until_true 90 no_message_over_the_image || fail "a message stays over the image: $(grep '"Card/' "$probe")"
    until_true 60 settled || fail "the window never settles"
    local x y w h
    x=$(number 1 x) y=$(number 1 y) w=$(image_size width) h=$(image_size height)
    import -window root -crop "${w%.*}x${h%.*}+${x%.*}+${y%.*}" +repage "$1" || fail "no screenshot"
}
# at_rest WIDGET: it stays where it is.
at_rest() {
    local before
    before=$(widget "$1")
    sleep 0.2
    [ -n "$before" ] && [ "$(widget "$1")" = "$before" ]
}
# take_last IMAGE: when the image does not change any more, for changes that are no edits of the image.
take_last() {
    stays() { mv "$1" earlier.png && sleep 0.5 && take_image "$1" && [ "$(differing earlier.png "$1")" = 0 ]; }
    take_image "$1"
    until_true 60 stays "$1" || fail "the image never rests"
}
# at U V: screen position of a point in per cent of the image's width and height.
at() { echo "$(number 1 x) $(image_size width) $(number 1 y) $(image_size height) $1 $2" | awk '{ printf "%d %d", $1 + $2 * $5 / 100, $3 + $4 * $6 / 100 }'; }
click_at() {
    point_at $(at "$1" "$2")
    click_here
}
# drag_over U V U V
drag_over() { drag_from $(at "$1" "$2") $(at "$3" "$4"); }
# type_into FIELD TEXT: replaces the field's text.
type_into() {
    click "$1"
    hold ctrl+a
    type_text "$2"
    hold Return
}
# type_number FIELD NUMBER: after a double-click, as fields of numbers need.
type_number() {
    double_click "$1"
    type_text "$2"
    hold Return
}
# expect_number FIELD NUMBER: what Ctrl+C copies from it, to a thousandth.
expect_number() {
    local copied
    point_at_widget "$1"
    press ctrl+c
    until_true 10 says "Copied" || fail "$1 cannot be copied"
    copied=$(sed -n '1s/.*"toast":"Copied \([-0-9.e]*\).*/\1/p' "$probe")
    echo "$copied $2" | awk '{ d = $1 - $2; exit !(d * d < 1e-6) }' || fail "$1 is $copied, not $2"
}
# enter_path PATH: into the file browser.
enter_path() {
    until_true 30 has_widget "Browser/Path" || fail "no file browser opens"
    until_true 30 typing || fail "the path in the file browser has no keyboard"
    hold ctrl+a
    type_text "$1"
    hold Return
}
# holding KEYS... -- COMMAND...
holding() {
    local key keys=()
    while [ "$1" != -- ]; do keys+=("$1") && shift; done
    shift
    for key in "${keys[@]}"; do input 1 xdotool keydown "$key"; done
    "$@"
    for key in "${keys[@]}"; do input 1 xdotool keyup "$key"; done
}
# mean IMAGE: mean display luminance. clipped IMAGE: fraction of its pixels with a channel at white.
mean() { convert "$1" -colorspace Gray -format '%[fx:mean]' info:; }
clipped() { convert "$1" -depth 8 txt:- | awk -F'[(),]' 'NR > 1 { ++n; if ($3 >= 255 || $4 >= 255 || $5 >= 255) ++c } END { print c / n }'; }
# A banner covers the middle of the image: it is closed first.
well_exposed() {
    local m c
    m=$(mean "$1") c=$(clipped "$1")
    awk -v m="$m" -v c="$c" 'BEGIN { exit !(m >= 0.1 && m <= 0.6 && c < 0.05) }' || fail "$1 has a mean of $m, and $c of it is clipped"
}
# Number of pixels in which two images differ.
differing() { compare -metric AE "$1" "$2" null: 2>&1 | awk '{ printf "%d", $1 }'; }
expect_changed() { [ "$(differing "$1" "$2")" -gt 1000 ] || fail "$3 changes nothing"; }
expect_same() { [ "$(differing "$1" "$2")" = 0 ] || fail "$3 does not restore the image: $(differing "$1" "$2") pixels differ"; }
# restores WHAT IMAGE STEPS: this many undo steps restore the image.
restores() {
    local i
    for i in $(seq "$3"); do after_edit press ctrl+z; done
    take_image undone.png
    expect_same "$2" undone.png "undoing $1"
}
# brightest IMAGE: position of its brightest point after blurring, as x and y from its upper left corner.
brightest() {
    convert "$1" -colorspace Gray -blur 0x2 -depth 16 txt:- |
        awk -F'[,:() ]+' 'NR > 1 && $3 + 0 > best { best = $3 + 0; x = $1; y = $2 } END { print x, y }'
}
# expect_brightest IMAGE U V: it is at this position, in per cent of width and height.
expect_brightest() {
    local x y
    read -r x y <<<"$(brightest "$1")"
    echo "$x $y $(image_size width) $(image_size height) $2 $3" |
        awk '{ dx = $1 / $3 - $5 / 100; dy = $2 / $4 - $6 / 100; exit !(dx * dx + dy * dy < 0.02 * 0.02) }' ||
        fail "the brightest place of $1 is at $x $y of $(image_size width) x $(image_size height), not at $2 % $3 %"
}
