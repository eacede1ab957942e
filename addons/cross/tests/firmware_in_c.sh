#!/bin/sh
# firmware_in_c.sh SPOOLFLOW MODEL FIRMWARE TARGET...: what `export c` writes for each core links by a C compiler alone, asks for no other
# library than the compiler's, and on emulated boards its examples end with status 0, the self-test among
# them; a damaged library fails it. FIRMWARE: the folder with board.ld.
set -eu
spoolflow=$(readlink -f "$1") model=$(readlink -f "$2") board=$(readlink -f "$3")/board.ld start=$(dirname "$(readlink -f "$0")")/start.c
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
run() { # MACHINE IMAGE
  qemu-system-arm -M "$1" -display none -serial none -monitor none -semihosting-config enable=on,target=native -kernel "$2" </dev/null
}
shift 3
for target in "$@"; do
  "$spoolflow" export c "$model" --target $target -o "$folder/$target"
  cd "$folder/$target"
  sha256sum --quiet -c exported.sha256
  "$spoolflow" inspect valve_page.bin | grep -q 'The sensor takes it'
  options=$(sed -n 's/^arm-none-eabi-gcc -std=c99 -O2 \(.*\) -ffunction-sections.*/\1/p' README.md)
  for foreign in $(arm-none-eabi-nm --undefined-only libvalve_sensor.a | sed -n 's/^ *U //p' | sort -u); do
    case $foreign in
      __aeabi_* | sqrtf | memset | memcpy | valve_sensor_* | _Z*) ;; # libgcc's; libm's and libc's where the core has less; its own
      *) echo "$target: the library asks for $foreign" >&2 && exit 1 ;;
    esac
  done
  for example in example example_pages example_references; do
    arm-none-eabi-gcc -std=c99 -O2 $options -ffunction-sections -Wall -Wextra -Wpedantic -Wconversion -Werror -I. -c $example.c
    arm-none-eabi-gcc -std=c99 -O2 $options -nostartfiles -T "$board" -Wl,--gc-sections "$start" $example.o -L. -lvalve_sensor -lm -o $example.elf
    case $target in
      cortex-m4f) run mps2-an386 $example.elf ;;
      cortex-m7) run mps2-an500 $example.elf ;;
      m3) run mps2-an385 $example.elf ;;
    esac
  done
  arm-none-eabi-size example.elf | sed -n "2s/^ *\([0-9]*\).*/$target: \1 bytes of flash with the step, tables and start-up/p"
done

# A number of the tables that has fallen: the self-test sees it.
cd "$folder/cortex-m4f"
arm-none-eabi-objcopy -O binary -j .text example_pages.elf text.bin
python3 - text.bin valve_page.bin <<'EOF'
import sys
text, page = (open(name, "rb").read() for name in sys.argv[1:])
piece = page[4000:4032]  # of a table: it stands in the image of flash, too
assert text.count(piece) == 1, text.count(piece)
at = text.index(piece)
open(sys.argv[1], "wb").write(text[:at + 1] + bytes([text[at + 1] ^ 4]) + text[at + 2:])
EOF
arm-none-eabi-objcopy --update-section .text=text.bin example_pages.elf fallen.elf
status=0
run mps2-an386 fallen.elf || status=$?
test "$status" = 2

refused() { # WHAT THE MESSAGE SAYS
  said=$1
  shift
  status=0
  "$spoolflow" export c "$@" 2>said.txt || status=$?
  test "$status" = 2
  grep -q -e "$said" said.txt
}
refused 'cortex-m4f cortex-m7' "$model" -o "$folder/none"
refused "'m5'" "$model" --target m5 -o "$folder/none"
test ! -e "$folder/none"
