# Two networks with a cable between them: a robot in this one (10.9.0.1), somebody else in the other (10.9.0.2).
# To be sourced. `own_networks "$0" "$@"` first: it starts the script again in network and process namespaces of
# its own, with an empty folder that is gone with it, and ends with 77 where that cannot be. Sets work and other.
own_networks() {
  if [ -z "${OWN_NETWORKS:-}" ]; then
    [ "$(id -u)" = 0 ] || { echo "this makes networks of its own, which takes root"; exit 77; }
    unshare --net ip link add probe type veth 2>/dev/null || { echo "no network namespaces here"; exit 77; }
    local folder status=0
    folder=$(mktemp -d)
    OWN_NETWORKS=$folder unshare --net --pid --fork --kill-child --mount-proc "$@" || status=$?
    [ -n "${KEEP_WORK:-}" ] && echo "its files stay in $folder" || rm -rf "$folder"
    exit "$status"
  fi
  work=$OWN_NETWORKS
}

# The robot's multicast goes out at the cable, the worst case.
cable() {
  ip link set lo up multicast on
  ip link add robot0 type veth peer name other0
  unshare --net sleep 100000 & other=$!
  until [ "$(readlink /proc/$other/ns/net)" != "$(readlink /proc/$$/ns/net)" ]; do sleep 0.01; done
  ip link set other0 netns $other
  ip address add 10.9.0.1/24 dev robot0
  ip link set robot0 up multicast on
  ip route add 239.0.0.0/8 dev robot0
  there ip link set lo up multicast on
  there ip address add 10.9.0.2/24 dev other0
  there ip link set other0 up multicast on
  there ip route add 239.0.0.0/8 dev other0
}
there() { nsenter --target $other --net "$@"; }
