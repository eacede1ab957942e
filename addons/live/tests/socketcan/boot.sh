#!/bin/sh
# boot.sh COMMAND EXAMPLES EDS PACKAGES: `spoolflow live` on SocketCAN. Debian's kernel, with CAN as a module, runs in an emulated
# machine that has a virtual bus, the program, and can-utils beside it (machine.sh); what was heard there is judged here with python-can.
# The kernel's package is fetched into the folder PACKAGES and unpacked, never installed. 77: something for it is not there.
set -eu
here=$(dirname "$(readlink -f "$0")")
command=$1 examples=$2 eds=$3 packages=$4
for needed in qemu-system-x86_64:qemu-system-x86 busybox:busybox-static candump:can-utils cansend:can-utils cpio:cpio dpkg-deb:dpkg; do
  command -v "${needed%:*}" >/dev/null || { echo "SKIPPED: ${needed%:*} is not here (Debian: ${needed#*:})"; exit 77; }
done
[ "$(uname -m)" = x86_64 ] || { echo "SKIPPED: the emulated machine runs this machine's programs, and they are not of x86-64"; exit 77; }
kernel=$(apt-cache depends linux-image-amd64 2>/dev/null | sed -n 's/^ *Depends: \(linux-image-[0-9].*\)$/\1/p' | head -n 1)
[ -n "$kernel" ] || { echo "SKIPPED: apt-cache knows no linux-image-amd64 (apt-get update)"; exit 77; }
mkdir -p "$packages"
find_package() { find "$packages" -maxdepth 1 -name "${kernel}_*.deb" | sort | tail -n 1; }
if [ -z "$(find_package)" ] && ! (cd "$packages" && apt-get -qq download "$kernel") >"$packages/apt.log" 2>&1; then
  tail -n 2 "$packages/apt.log"
  echo "SKIPPED: the package $kernel could not be fetched"
  exit 77
fi

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
mkdir -p unpacked machine/bin machine/site machine/modules heard
dpkg-deb --fsys-tarfile "$(find_package)" | tar -x -C unpacked --wildcards './boot/vmlinuz-*' '*/net/can/*'
for module in net/can/can net/can/can-raw drivers/net/can/dev/can-dev drivers/net/can/vcan; do
  cp unpacked/lib/modules/*/kernel/$module.ko machine/modules
done
for program in "$command" "$(dirname "$command")/spoolflow-live" "$(command -v candump)" "$(command -v cansend)"; do
  cp -L "$program" machine/bin
  for library in $(ldd "$program" | grep -o '/[^ ]*'); do
    mkdir -p "machine$(dirname "$library")"
    cp -L "$library" "machine$library"
  done
done
cp -L "$(command -v busybox)" machine/bin/busybox
cp "$examples/live/size_6.json" machine/site/model.json
cp "$here/machine.sh" machine/init
/usr/bin/python3 "$here/judge.py" reads "$eds" >machine/site/reads
(cd machine && find . | cpio -o -H newc --quiet | gzip -1) >machine.gz

# The second serial line carries what was heard, as a tar archive.
status=0
timeout 1200 qemu-system-x86_64 -accel tcg -cpu max -smp 2 -m 1024 -nic none -display none -monitor none -no-reboot \
  -kernel unpacked/boot/vmlinuz-* -initrd machine.gz -append 'console=ttyS0 loglevel=4 panic=-1' \
  -serial file:console -serial file:heard.tar </dev/null >qemu.log 2>&1 || status=$?
if [ "$status" -ne 0 ] || ! tar -x -C heard -f heard.tar; then
  tail -n 40 qemu.log console
  echo "the machine ended with $status"
  exit 1
fi
[ -z "${SPOOLFLOW_HEARD:-}" ] || cp -r heard console "$SPOOLFLOW_HEARD"
/usr/bin/python3 "$here/judge.py" judge "$eds" heard
