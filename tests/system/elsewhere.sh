#!/usr/bin/env bash
# A robot in one network, operators in another, a cable between: what they may and may not, who drives, a
# revoked key, a bad wireless network, a link that is cut while the robot walks.
# usage: elsewhere.sh SOURCE_DIR BIN_DIR      77: not as root, or no network namespaces
set -euo pipefail
source_dir=$1 bin=$2
. "$source_dir/tests/system/two_networks.sh"
own_networks "$0" "$@"
. "$source_dir/tests/system/elsewhere_setup.sh"

robot_up pegasus
for who in alice:drive bob:maintain wendy:watch; do
  robot operator key new "${who%:*}" --role "${who#*:}" --out "$work/${who%:*}.key" >/dev/null
done
gateway_up
robot home >"$work/said" || { cat "$work/said"; fail "home"; }
said() { "$@" >"$work/said" 2>&1 || { cat "$work/said"; fail "$*"; }; }
refused() { local what=$1; shift; ! "$@" >"$work/said" 2>&1 || fail "was not refused: $*"; grep -q "$what" "$work/said" || { cat "$work/said"; fail "said nothing of '$what': $*"; }; }

# Nothing of the robot's own network comes out; what is sent to go out does, so the listener would hear it.
elsewhere python3 "$source_dir/tests/system/hear_nothing.py" 239.255.76.69 7700 10.9.0.2
elsewhere python3 "$source_dir/tests/system/hear_nothing.py" 239.255.76.69 7701 10.9.0.2 >"$work/heard" 2>&1 & listener=$!
for _ in 1 2 3 4 5 6 7 8; do
  python3 -c 'import socket; s = socket.socket(socket.AF_INET, socket.SOCK_DGRAM); s.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 1); s.sendto(b"out", ("239.255.76.69", 7701))'
  sleep 0.1
done
! wait $listener || fail "the listener would hear nothing"
grep -q 'heard 3 bytes' "$work/heard" || { cat "$work/heard"; fail "the listener"; }

said via alice status
grep -q 'as alice (drive); nobody drives' "$work/said" || { cat "$work/said"; fail "who drives"; }
refused 'key is to watch' via wendy stand
said via alice stand
refused 'alice drives' via bob sit
said via bob status
grep -q 'alice drives' "$work/said" || { cat "$work/said"; fail "bob does not see who drives"; }
refused 'only who drives hands over' via bob hand-over bob
said via alice hand-over bob
refused 'bob drives' via alice sit
said via bob hand-over alice
refused 'key is to drive' via alice home
refused "of the robot's own computer" via alice down
said via wendy estop
said via alice --encrypt clear
said via alice stand

# A bad network: it walks, and stops when told.
wifi --loss 0.05 --delay-ms 100 --jitter-ms 50 --cut "$work/cut"
over() { local who=$1; shift; elsewhere "$bin/sprung" --via 127.0.0.1:7500 --key "$work/$who.key" "$@"; }
# A machine that stalls for as long as the link may be silent loses the link, and says so: then once more.
link_losses() { grep -c 'link to who moves the robot is lost' "$audit" || true; }
walks_on() {
  over alice walk --speed 0.2 >"$work/walk" 2>&1 & walk=$!
  until_phase walking || { cat "$work/walk"; fail "it does not walk over a bad network"; }
  sleep 4
  [ "$(phase)" = walking ]
}
for try in 1 2 3; do
  lost=$(link_losses)
  walks_on && break
  cat "$work/walk" "$work/wifi.txt" "$audit"
  [ "$(link_losses)" -gt "$lost" ] && [ $try != 3 ] || fail "it does not go on walking: $(phase)"
  wait $walk || true
  until_phase standing || fail "it does not stand: $(phase)"
done
# Cut: it stands within 2 s, and the other end says so.
touch "$work/cut"
began=$(date +%s%N)
until_phase standing || fail "the link is cut, and the robot does not stand: $(phase)"
took_ms=$((($(date +%s%N) - began) / 1000000))
echo "link cut while it walks: stands after $took_ms ms"
kill -INT $walk 2>/dev/null || true
wait $walk || true
rm "$work/cut"
grep -q 'link to who moves the robot is lost' "$audit" || { cat "$audit"; fail "the audit log does not say so"; }
said over alice estop
said over alice clear

# Parameters: everybody may look, who maintains sets, while he drives or nobody does.
said via wendy param get stand_length
grep -q '^0.525 m$' "$work/said" || { cat "$work/said"; fail "param get"; }
refused 'key is to drive' via alice param set stand_length 0.5
said via alice hand-over bob
said via bob param set stand_length 0.5
refused 'a limit may only be tightened' via bob param set gaits.trot.fastest.forward 2
refused 'on the robot' via bob param save
said via wendy param diff
grep -q 'stand_length .*0.5 m' "$work/said" || { cat "$work/said"; fail "param diff"; }
said via bob hand-over alice

# Logs come over the bad network, and go on where they were interrupted.
log=$(basename "$(ls "$work"/pegasus*.txt)")
said over wendy fetch
grep -q "$log" "$work/said" || { cat "$work/said"; fail "fetch lists no $log"; }
size=$(stat -c %s "$work/$log") && mkdir -p "$work/here"
head -c $((size / 3)) "$work/$log" >"$work/here/$log.part"
said over wendy fetch "$log" --into "$work/here"
grep -q 'gone on' "$work/said" || { cat "$work/said"; fail "fetch began anew"; }
cmp -n "$size" "$work/$log" "$work/here/$log" || fail "what was fetched is not the robot's"
refused 'no log' over wendy fetch operators.json

# A key that is lost: at once.
robot operator key revoke alice >/dev/null
sleep 1.2
refused 'was revoked' via alice stand
robot down >/dev/null
echo "operators elsewhere: roles, driver, keys, bad network, lost link"
