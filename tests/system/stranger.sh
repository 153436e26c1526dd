#!/usr/bin/env bash
# A robot runs while hostile datagrams reach its LCM network: from another computer (a network namespace
# behind a cable), by multicast and to its address, malformed ones and copies of what the robot itself had
# said; and malformed ones from this machine. Nothing ends, nothing is obeyed, the strangers are counted.
# usage: stranger.sh SOURCE_DIR BIN_DIR [COUNT]      77: not as root, or no network namespaces
set -euo pipefail
source_dir=$1 bin=$2 count=${3:-1000}
if [ -z "${STRANGER_INSIDE:-}" ]; then
  [ "$(id -u)" = 0 ] || { echo "this makes networks of its own, which takes root"; exit 77; }
  unshare --net ip link add probe type veth 2>/dev/null || { echo "no network namespaces here"; exit 77; }
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
  STRANGER_INSIDE=$work unshare --net --pid --fork --kill-child --mount-proc "$0" "$source_dir" "$bin" "$count"
  exit
fi
work=$STRANGER_INSIDE
group=239.255.76.69 port=7700 hostile=$source_dir/tests/system/hostile_datagrams.py
fail() { echo "FAILED: $*"; cat "$work/up.txt"; exit 1; }
export SPRUNG_RUN_DIR=$work/run SPRUNG_PROGRAMS=$bin SPRUNG_MIXED_BUILDS=1
sprung() { "$bin/sprung" "$@"; }

# The cable: the robot's multicast goes out there, the worst case.
ip link set lo up
ip link add robot0 type veth peer name stranger0
unshare --net sleep 1000 & other=$!
until [ "$(readlink /proc/$other/ns/net)" != "$(readlink /proc/$$/ns/net)" ]; do sleep 0.01; done
ip link set stranger0 netns $other
ip address add 10.9.0.1/24 dev robot0
ip link set robot0 up multicast on
ip route add 239.0.0.0/8 dev robot0
stranger() { nsenter --target $other --net "$@"; }
stranger ip address add 10.9.0.2/24 dev stranger0
stranger ip link set stranger0 up multicast on
stranger ip route add 239.0.0.0/8 dev stranger0

sprung up single_leg --sim --clock lockstep --speed 1 --log "$work" --lcm-url "udpm://$group:$port?ttl=0&recv_buf_size=4194304" \
  >"$work/up.txt" 2>&1 & up=$!
until grep -q 'is up' "$work/up.txt"; do kill -0 $up || fail "the robot did not come up"; sleep 0.1; done
pids() { sprung status --json | python3 -c 'import json,sys; print(sorted((p["name"], p["pid"], p["state"]) for p in json.load(sys.stdin)["processes"]))'; }
sprung stand >/dev/null
before=$(pids)
python3 "$hostile" $group $port --listen "$work/heard" --count 500

stranger python3 "$hostile" $group $port --seed 1 --count "$count" --to 10.9.0.1 --again "$work/heard" &
python3 "$hostile" $group $port --seed 2 --count "$count" --to 127.0.0.1 &
jump=$(sprung jump --report) || fail "it did not jump: $jump"
wait %?seed\ 1 && wait %?seed\ 2
[[ $jump == *"  yes"* ]] || fail "not upright: $jump"
[ "$(pids)" = "$before" ] || fail "processes: $before, then $(pids)"
# Well-formed ones: from this machine heard, from outside not, whoever they claim to come from.
python3 "$hostile" $group $port --plain FROM_HERE
stranger python3 "$hostile" $group $port --plain FROM_OUTSIDE
stranger python3 "$hostile" $group $port --plain FROM_SPOOFED --interface stranger0 \
  --source 10.9.0.1 --source 127.0.0.1 --source 0.0.0.0 --source 10.9.0.77
said=$(sprung status --json)
python3 - "$said" <<'EOT' || fail "$said"
import json, sys
status = json.loads(sys.argv[1])
assert status["safety"]["state"] == "operational", status["safety"]
refused = {p["name"]: p["refused_messages"] for p in status["processes"]}
print("refused:", refused)
assert all(refused[name] > 100 for name in refused if name not in ("sprung-recorder",)), refused
EOT
sprung status >"$work/status"
grep -q '^refused sprung-can-bridge: ' "$work/status" || { cat "$work/status"; fail "refused messages are not in the table"; }
sprung down >/dev/null
wait $up || fail "sprung up ended with $?"
sprung log info "$work"/*.lcm >"$work/info" || { cat "$work/info"; fail "the log"; }
grep -q FROM_HERE "$work/info" || { cat "$work/info"; fail "a message from this machine was not heard"; }
! grep -E 'FROM_(OUTSIDE|SPOOFED)' "$work/info" || fail "somebody else was heard"
echo "$((2 * count)) hostile datagrams from two sides: nothing ended, nothing was obeyed"
