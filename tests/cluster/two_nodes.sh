#!/usr/bin/env bash
# A real Slurm on this machine: a controller and two nodes, n1 and n2, of one core each.
#   two_nodes.sh COMMAND...    starts it, runs the command beside it, and ends everything
#   two_nodes.sh --lose NODE   in the command: a node is gone at once, with all that runs on it
# In the command, Slurm's programs use this Slurm (SLURM_CONF). The exit code is that of the command,
# or 77 if a package is missing. Neither root nor systemd is needed. Folder, ports, munge key and socket
# are its own: it disturbs no other Slurm on this machine.
set -euo pipefail
PATH=$PATH:/usr/sbin

# Processes of this Slurm and of the command: their environment names its configuration.
marked() {
  grep -lzxF "SLURM_CONF=$folder/slurm.conf" /proc/[0-9]*/environ 2>/dev/null || true
}

# Processes of a node, in the order in which they must end: a step daemon would report that its task
# was killed, and Slurm would count the task as failed instead of lost. Step daemons clear their
# environment, so they are found by the working directory that they have from the node's daemon.
of_node() {
  find /proc -maxdepth 2 -name cwd -lname "$folder/$1" 2>/dev/null || true
  marked | xargs -r grep -lzxF "SLURMD_NODENAME=$1" 2>/dev/null || true
}

# kill_all FUNCTION ARGUMENT...: until the function lists no process. They may end in the meantime.
kill_all() {
  local found
  while mapfile -t found < <("$@" | tr -dc '0-9\n') && [ ${#found[@]} -gt 0 ]; do
    kill -KILL "${found[@]}" 2>/dev/null || true
    sleep 0.1
  done
}

if [ "${1:-}" = --lose ]; then
  folder=$(dirname "$SLURM_CONF")
  [ -n "$(of_node "$2")" ] || { echo "two_nodes.sh: nothing runs on $2" >&2; exit 1; }
  kill_all of_node "$2"
  exit
fi

if [ "${1:-}" = --clean ]; then  # when standard input ends
  folder=$2
  cat >/dev/null
  kill_all marked
  kill_all of_node n1
  kill_all of_node n2
  rm -rf "$folder"
  exit
fi

# ------------------------------------------------------------------------------------- configuration
missing=''
for entry in munge:munged slurmctld:slurmctld slurmd:slurmd slurm-client:sbatch; do
  command -v "${entry#*:}" >/dev/null || missing+=" ${entry%:*}"
done
skip() { echo "Skipped: $1"; exit 77; }
[ -z "$missing" ] || skip "Debian packages are missing:$missing"
user=$(id -un 2>/dev/null) || skip "Slurm needs a user with a name"
host=$(uname -n)

unset "${!SLURM@}" "${!SBATCH@}" "${!SQUEUE@}" "${!SINFO@}"  # of a job that this may run in
folder=$(mktemp -d)  # a short path: that of a socket has at most 107 characters
# A process of its own session cleans up, and so does even when this one is killed: it reads from
# channel 9, which ends with this process, because no other has it.
exec 9> >(exec setsid --fork bash "$0" --clean "$folder" >/dev/null 2>&1)
finish() {
  local code=$?
  trap '' INT TERM HUP
  [[ $code =~ ^(0|77|129|130|143)$ ]] || tail -n 40 "$folder"/log/* >&2
  exec 2>/dev/null 9>&-  # no message of bash about each process
  for _ in {1..300}; do [ -d "$folder" ] || break; sleep 0.1; done
}
trap finish EXIT
trap 'exit 129' HUP
trap 'exit 130' INT
trap 'exit 143' TERM

mkdir "$folder"/{log,n1,n2,state}
head -c 128 /dev/urandom >"$folder/key"
chmod 600 "$folder/key"

# Three free ports in a row, below those that the system gives to outgoing connections.
port=$((10000 + RANDOM % 20000))
in_use() { grep -q ":$(printf %04X "$1") " /proc/net/tcp*; }
while in_use $port || in_use $((port + 1)) || in_use $((port + 2)); do port=$((port + 3)); done

# The name of the machine need not resolve. A lost node is noticed after SlurmdTimeout [s]; its tasks
# are held for cred_expire [s] more. Tasks are queued again only if they ask for it.
cat >"$folder/slurm.conf" <<END
ClusterName=two_nodes
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
AuthInfo=socket=$folder/munge,cred_expire=20
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/%n
SlurmctldPidFile=$folder/controller.pid
SlurmdPidFile=$folder/%n.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
SelectType=select/linear
JobRequeue=0
MinJobAge=86400
ReturnToService=2
SlurmdTimeout=30
NodeName=n[1-2] NodeHostname=$host NodeAddr=127.0.0.1 Port=[$((port + 1))-$((port + 2))] CPUs=1
PartitionName=all Nodes=ALL Default=YES
END
# Nothing here uses control groups. This plugin, unlike the other, starts where there are none, and in
# containers, where they are read-only.
echo CgroupPlugin=cgroup/v1 >"$folder/cgroup.conf"

# ----------------------------------------------------------------------------------------------- run
# start NAME COMMAND...: in the folder of that name, if there is one.
start() {
  local name=$1
  shift
  (
    cd "$folder/$name" 2>/dev/null || cd "$folder"
    exec env SLURM_CONF="$folder/slurm.conf" "$@"
  ) >"$folder/log/$name" 2>&1 9>&- &
}
# until_true COMMAND...: fails if a daemon has ended, or after a minute.
until_true() {
  local end=$((SECONDS + 60)) daemons
  daemons=$(jobs -p | wc -l)
  until "$@"; do
    if [ "$(jobs -pr | wc -l)" -lt "$daemons" ] || [ $SECONDS -gt $end ]; then
      echo "two_nodes.sh: Slurm does not start; its logs follow" >&2
      exit 1
    fi
    sleep 0.2
  done
}
# --force: the folder may be closed to other users.
start munged munged --foreground --force --key-file="$folder/key" --socket="$folder/munge" \
  --pid-file="$folder/munged.pid" --seed-file="$folder/seed"
until_true [ -S "$folder/munge" ]
start controller slurmctld -D
start n1 slurmd -D -N n1
start n2 slurmd -D -N n2
both_idle() {
  [ "$(SLURM_CONF="$folder/slurm.conf" sinfo --noheader --states=idle --format=%D 2>/dev/null)" = 2 ]
}
until_true both_idle

# In the background, because bash handles a signal only after a command in the foreground has ended.
SLURM_CONF="$folder/slurm.conf" "$@" <&0 9>&- &
wait $! 2>/dev/null  # no message of bash about a lost node
