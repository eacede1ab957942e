#!/bin/busybox sh
# The first process of the emulated machine (boot.sh): makes the bus, runs `spoolflow live` on it, plays its masters and its mishaps, and hands
# out what was heard. Frames of the identifier 7E0h mark where a part of the story begins.
export PATH=/bin
/bin/busybox mkdir -p /proc /sys /dev /tmp /heard
/bin/busybox --install -s /bin
mount -t proc proc /proc
mount -t sysfs sysfs /sys
mount -t devtmpfs dev /dev
for module in can can-raw can-dev vcan; do insmod /modules/$module.ko; done
ip link set lo up
cd /site || exit

write_site() { # INTERFACE: one valve whose samples come, one beside it, one whose samples never come
  cat <<END
[page]
listen = "127.0.0.1:8080"
[can]
interface = "$1"
auxiliary_valve = { a = 3, c = 4 }
node = { a = 17, b = 18, c = 19 }
[[valve]]
id = "a"
model = "model.json"
source = { kind = "rig", seed = 1 }
[[valve]]
id = "b"
model = "model.json"
source = { kind = "rig", seed = 2 }
[[valve]]
id = "c"
model = "model.json"
source = { kind = "tcp", listen = "127.0.0.1:7001" }
END
}
refused() { # INTERFACE NAME: starts that must not go on
  write_site "$1" >"$2.toml"
  timeout 60 spoolflow live "$2.toml" 2>"/heard/$2.said"
  echo $? >"/heard/$2.status"
}
make_bus() {
  ip link add dev vcan0 type vcan
  ip link set vcan0 up
}
send() { cansend vcan0 "$1" && sleep "${2:-0.5}"; }
mark() { send "7E0#0$1"; }
ask_site() { timeout 30 wget -q -O "/heard/$1.json" http://127.0.0.1:8080/api/v1/site; }
until_heard() { # PATTERN: for five minutes
  for _ in $(seq 300); do
    grep -q "$1" /heard/bus.log && return
    sleep 1
  done
  echo "never heard: $1" >>/heard/missing
}

refused nocan9 absent
ip link add dev vcan0 type vcan
refused vcan0 down
ip link set vcan0 up

candump -L any >/heard/bus.log 2>/heard/candump.said &
sleep 1
write_site vcan0 >site.toml
spoolflow live site.toml 2>/heard/live.said &
live=$!
until_heard ' 191#0F00'
ask_site running
sleep 10

mark 1 # objects of the EDS, then what is refused, then what is nobody's request
while read -r request; do send "$request" 0.2; done <reads
send 611#2B00200100000000
send 611#4000300000000000
send 611#4000204D00000000
mark 2
send 611#R
send 611#400010
send 00000611#4000100000000000
send 614#4000100000000000

mark 3 # NMT: pre-operational, stopped, without an answer, operational, reset
send 000#8012 4
mark 4
send 000#0212 2
send 612#4000100000000000 2
mark 5
send 000#0112 3
mark 6
send 000#8112 3

mark 7 # J1939: asked by all, by its address, at another's
send 18EAFFF9#00EE00
send 18EA80F9#00EE00
send 18EA81F9#00EE00
send 18EA80F9#00EF00

mark 8 # the interface goes down and comes up
ip link set vcan0 down
sleep 5
ask_site went_down
ip link set vcan0 up
sleep 5
ask_site came_up
mark 9 # and is taken away, and is another
ip link del vcan0
sleep 5
ask_site went_away
make_bus
sleep 5
ask_site came_back

send 7E0#0A # a device of a lesser NAME takes the address
send 18EEFF80#0000000000000000 4
ask_site lost
kill -TERM $live
wait $live
echo $? >/heard/live.status
uname -r >/heard/kernel
sync
stty -F /dev/ttyS1 raw
tar -c -C /heard . >/dev/ttyS1
sleep 2
poweroff -f
