# Two networks with a cable between them, a robot in this one, operators in the other. Sourced with $work, $bin,
# $source_dir; inside network and process namespaces of its own.
export SPRUNG_RUN_DIR=$work/run SPRUNG_STATE_DIR=$work/state SPRUNG_PROGRAMS=$bin SPRUNG_MIXED_BUILDS=1
audit=$work/state/operator-audit.jsonl
fail() { echo "FAILED: $*"; [ ! -e "$work/up.txt" ] || tail -5 "$work/up.txt"; [ ! -e "$work/gateway.txt" ] || cat "$work/gateway.txt"; exit 1; }
robot() { "$bin/sprung" "$@"; }

ip link set lo up multicast on
ip link add robot0 type veth peer name operator0
unshare --net sleep 100000 & other=$!
until [ "$(readlink /proc/$other/ns/net)" != "$(readlink /proc/$$/ns/net)" ]; do sleep 0.01; done
ip link set operator0 netns $other
ip address add 10.9.0.1/24 dev robot0
ip link set robot0 up multicast on
ip route add 239.0.0.0/8 dev robot0
elsewhere() { env -u SPRUNG_RUN_DIR -u SPRUNG_STATE_DIR nsenter --target $other --net "$@"; }
elsewhere ip link set lo up multicast on
elsewhere ip address add 10.9.0.2/24 dev operator0
elsewhere ip link set operator0 up multicast on
elsewhere ip route add 239.0.0.0/8 dev operator0
via() { local who=$1; shift; elsewhere "$bin/sprung" --via 10.9.0.1 --key "$work/$who.key" "$@"; }

robot_up() {
  robot up "$1" --sim --log "$work" --lcm-url "udpm://239.255.76.69:7700?ttl=0&recv_buf_size=4194304" >"$work/up.txt" 2>&1 & up=$!
  until grep -q 'is up' "$work/up.txt"; do kill -0 $up || fail "the robot did not come up"; sleep 0.1; done
}
gateway_up() {
  "$bin/sprung-operator-gateway" --listen 10.9.0.1 >"$work/gateway.txt" 2>&1 & gateway=$!
  until grep -q 'is up' "$work/gateway.txt"; do kill -0 $gateway || fail "the gateway ended"; sleep 0.05; done
}
wifi() {
  elsewhere python3 "$source_dir/tests/system/bad_wifi.py" 7500 10.9.0.1:7447 "$@" >"$work/wifi.txt" & wifi=$!
  until grep -q ready "$work/wifi.txt"; do kill -0 $wifi || fail "the relay ended"; sleep 0.05; done
}
phase() { robot status --json | python3 -c 'import json,sys; print(json.load(sys.stdin)["motion"]["state"])'; }
until_phase() { local i; for i in $(seq 100); do [ "$(phase)" = "$1" ] && return 0; sleep 0.05; done; return 1; }
