# A robot in this network, operators in the other. To be sourced after own_networks (two_networks.sh), with $bin
# and $source_dir.
export SPRUNG_RUN_DIR=$work/run SPRUNG_STATE_DIR=$work/state SPRUNG_PROGRAMS=$bin SPRUNG_MIXED_BUILDS=1
audit=$work/state/operator-audit.jsonl
# What the link bears: 250 ms of silence, less what a bad network takes of them.
python3 "$source_dir/tests/system/stall_watch.py" 100 >"$work/stall" & stall_watch=$!
fail() { echo "FAILED: $*"; kill $stall_watch; wait $stall_watch; cat "$work/stall"; [ ! -e "$work/up.txt" ] || tail -5 "$work/up.txt"; [ ! -e "$work/gateway.txt" ] || cat "$work/gateway.txt"; exit 1; }
robot() { "$bin/sprung" "$@"; }

cable
elsewhere() { env -u SPRUNG_RUN_DIR -u SPRUNG_STATE_DIR nsenter --target $other --net "$@"; }
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
  # exec, so that what is killed is the relay, which then says what it has passed
  (exec nsenter --target $other --net python3 "$source_dir/tests/system/bad_wifi.py" 7500 10.9.0.1:7447 "$@") >"$work/wifi.txt" & wifi=$!
  until grep -q ready "$work/wifi.txt"; do kill -0 $wifi || fail "the relay ended"; sleep 0.05; done
}
phase() { robot status --json | python3 -c 'import json,sys; print(json.load(sys.stdin)["motion"]["state"])'; }
until_phase() { local i; for i in $(seq 100); do [ "$(phase)" = "$1" ] && return 0; sleep 0.05; done; return 1; }
