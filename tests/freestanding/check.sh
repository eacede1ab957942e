#!/bin/sh
# check.sh COMPILER SOURCE OBJECT INCLUDE_FOLDER…: compiles for bare metal and looks at what the object would need there.
# Allowed are the float functions of libm that compilers do not inline, and the copies that they may insert themselves.
set -eu
compiler=$1
source=$2
object=$3
shift 3
folders=
for folder; do folders="$folders -I$folder"; done
"$compiler" -std=c++17 -ffreestanding -fno-exceptions -fno-rtti -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion \
  -Wdouble-promotion -Wfloat-equal -Werror -O2 $folders \
  -c "$source" -o "$object"
needed=$(nm -C --undefined-only "$object" | awk '{ $1 = ""; print substr($0, 2) }')
refused=$(echo "$needed" | grep -vxE '|(sqrt|fabs|floor|ceil|fmin|fmax|exp|exp2|log|log2|pow|sin|cos|tan|atan|atan2|tanh|hypot|cbrt)f|mem(cpy|move|set|cmp)' || true)
echo "$compiler: undefined symbols:" ${needed:-none}
if [ -n "$refused" ]; then
  echo "$source needs what bare metal does not have:" $refused >&2
  exit 1
fi
