#!/bin/sh
# kernel_symbols_test.sh NM OBJECT...: weak symbols, which the linker may merge with those of other objects, must contain the name
# of the object's instruction set, or AVX-512 instructions could end up in code that every machine runs. Kernels must not call the
# mathematical functions of the C library, which are not bit-identical to ours. Objects are named v2, v3, v4.
set -eu
nm=$1
shift
failed=0
for object in "$@"; do
    level=$(basename "$object")
    level=${level%%.*}
    weak=$("$nm" "$object" | awk '$(NF - 1) ~ /^[WVu]$/ && $NF !~ /^DW\.ref\./ { print $NF }')
    own=$(printf '%s\n' "$weak" | grep -c "isa_$level" || true)
    foreign=$(printf '%s\n' "$weak" | grep -v "isa_$level" || true)
    if [ "$own" -eq 0 ]; then
        echo "$object: no symbol of isa_$level; is this a kernel?"
        failed=1
    fi
    if [ -n "$foreign" ]; then
        echo "$object: shared with other code:"
        printf '%s\n' "$foreign"
        failed=1
    fi
    calls=$("$nm" -u "$object" | awk '$NF ~ /^(exp|log|pow|sin|cos|sincos|tan|asin|acos|atan|floor|ceil|round|sqrt|cbrt)[0-9a-z]*$/ { print $NF }')
    if [ -n "$calls" ]; then
        echo "$object: calls the C library:"
        printf '%s\n' "$calls"
        failed=1
    fi
done
exit $failed
