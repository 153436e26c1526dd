# slurm_cluster FOLDER: a Slurm of one machine, with a key, ports and folders of its own; SLURM_CONF says where
# it is. It ends with `end_slurm_cluster`. Calls `skip WHY`, which the caller has, where it cannot be.
slurm_cluster() {
  local folder=$1 name cpus port
  for name in munged slurmctld slurmd sbatch; do
    command -v "$name" >/dev/null || PATH=$PATH:/usr/sbin command -v "$name" >/dev/null ||
      skip "there is no $name: apt-get install slurm-wlm munge"
  done
  [ "$(id -u)" = 0 ] || skip "slurmd needs root"
  PATH=$PATH:/usr/sbin
  mkdir -p "$folder"/{state,spool,munge}
  chmod 0700 "$folder/munge"
  cpus=$(nproc)
  port=$((20000 + $$ % 20000))
  dd if=/dev/urandom of="$folder/munge/key" bs=1024 count=1 status=none
  chmod 0400 "$folder/munge/key"
  cat > "$folder/slurm.conf" <<EOF
ClusterName=sprung
SlurmctldHost=$(hostname -s)(127.0.0.1)
AuthInfo=socket=$folder/munge/socket
AuthType=auth/munge
CredType=cred/munge
SlurmUser=root
SlurmctldPort=$port
SlurmdPort=$((port + 1))
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
SchedulerParameters=batch_sched_delay=0,sched_interval=1
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
NodeName=$(hostname -s) NodeAddr=127.0.0.1 CPUs=$cpus State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP OverSubscribe=NO
EOF
  export SLURM_CONF=$folder/slurm.conf
  munged --key-file="$folder/munge/key" --socket="$folder/munge/socket" --pid-file="$folder/munge/pid" \
    --log-file="$folder/munge/log" --seed-file="$folder/munge/seed" --force >"$folder/munged.txt" 2>&1 ||
    skip "munged does not start: $(tail -n 1 "$folder/munged.txt")"
  slurmctld -D -f "$SLURM_CONF" >"$folder/slurmctld.txt" 2>&1 &
  slurm_pids=$!
  slurmd -D -f "$SLURM_CONF" >"$folder/slurmd.txt" 2>&1 &
  slurm_pids="$slurm_pids $!"
  for _ in $(seq 100); do
    [ "$(sinfo -h -o %t 2>/dev/null)" = idle ] && return 0
    sleep 0.2
  done
  skip "Slurm does not come up here: $(tail -n 1 "$folder/slurmctld.txt") $(tail -n 1 "$folder/slurmd.txt")"
}

end_slurm_cluster() {
  [ -n "${slurm_pids:-}" ] || return 0
  kill $slurm_pids 2>/dev/null || true
  wait $slurm_pids 2>/dev/null || true
  kill "$(cat "$(dirname "$SLURM_CONF")/munge/pid")" 2>/dev/null || true
  slurm_pids=
}
