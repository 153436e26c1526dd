#!/usr/bin/env bash
# A robot runs while hostile datagrams reach its LCM network: from another computer (a network namespace
# behind a cable), by multicast and to its address, malformed ones and copies of what the robot itself had
# said; and malformed ones from this machine. Nothing ends, nothing is obeyed, the strangers are counted.
# usage: stranger.sh SOURCE_DIR BIN_DIR [COUNT]      77: not as root, or no network namespaces
set -euo pipefail
source_dir=$1 bin=$2 count=${3:-1000}
. "$source_dir/tests/system/two_networks.sh"
own_networks "$0" "$@"
group=239.255.76.69 port=7700 hostile=$source_dir/tests/system/hostile_datagrams.py
fail() { echo "FAILED: $*"; cat "$work/up.txt"; exit 1; }
export SPRUNG_RUN_DIR=$work/run SPRUNG_PROGRAMS=$bin SPRUNG_MIXED_BUILDS=1
sprung() { "$bin/sprung" "$@"; }

cable

sprung up single_leg --sim --clock lockstep --speed 1 --log "$work" --lcm-url "udpm://$group:$port?ttl=0&recv_buf_size=4194304" \
  >"$work/up.txt" 2>&1 & up=$!
until grep -q 'is up' "$work/up.txt"; do kill -0 $up || fail "the robot did not come up"; sleep 0.1; done
pids() { sprung status --json | python3 -c 'import json,sys; print(sorted((p["name"], p["pid"], p["state"]) for p in json.load(sys.stdin)["processes"]))'; }
sprung stand >/dev/null
before=$(pids)
python3 "$hostile" $group $port --listen "$work/heard" --count 500

there python3 "$hostile" $group $port --seed 1 --count "$count" --to 10.9.0.1 --again "$work/heard" &
python3 "$hostile" $group $port --seed 2 --count "$count" --to 127.0.0.1 &
jump=$(sprung jump --report) || fail "it did not jump: $jump"
wait %?seed\ 1 && wait %?seed\ 2
[[ $jump == *"  yes"* ]] || fail "not upright: $jump"
[ "$(pids)" = "$before" ] || fail "processes: $before, then $(pids)"
# Well-formed ones: from this machine heard, from outside not, whoever they claim to come from.
python3 "$hostile" $group $port --plain FROM_HERE
there python3 "$hostile" $group $port --plain FROM_OUTSIDE
there python3 "$hostile" $group $port --plain FROM_SPOOFED --interface other0 \
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
