#!/bin/sh
# run.sh SPOOLFLOW VALVE_ON_RIG: exports the valve's parameters twice, as they were and as a newer calibration, builds the
# firmware with nothing of a valve in it, and runs it on an emulated Cortex-M4F against the valve of the virtual rig.
set -eu
spoolflow=$1 valve_on_rig=$2
here=$(cd "$(dirname "$0")" && pwd)
root=$here/../..
board=$root/tests/cortex_m/firmware
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
SOURCE_DATE_EPOCH=1700000000 "$spoolflow" export parameters "$here/whole_size_6.json" --sensors observer -o valve.bin 2>said || { cat said; exit 1; }
SOURCE_DATE_EPOCH=1700003600 "$spoolflow" export parameters "$here/whole_size_6.json" --sensors observer -o newer.bin 2>said || { cat said; exit 1; }
arm-none-eabi-g++ -std=c++17 -mcpu=cortex-m4 -mfpu=fpv4-sp-d16 -mthumb -mfloat-abi=hard -O2 -ffreestanding -fno-exceptions \
  -fno-rtti -fno-threadsafe-statics -fno-tree-loop-distribute-patterns -ffunction-sections -fdata-sections -Wall -Wextra \
  -Wconversion -Wdouble-promotion -Werror -I"$root" -I"$here" -I"$board" "$here/firmware.cpp" "$board/board.cpp" \
  -o position_control.elf -nostartfiles -nostdlib -Wl,--gc-sections -T "$board/board.ld" -lgcc
mkfifo samples answers
qemu-system-arm -M mps2-an386 -display none -serial none -monitor none -chardev stdio,id=c0 \
  -semihosting-config enable=on,target=native,chardev=c0 -icount shift=6 -kernel position_control.elf </dev/null >log 2>&1 &
emulator=$!
status=0
timeout 120 "$valve_on_rig" samples answers || status=$?
if [ $status -eq 124 ]; then kill $emulator || true; fi  # it waits at the other end
wait $emulator || { cat log; exit 1; }
cat log
exit $status
