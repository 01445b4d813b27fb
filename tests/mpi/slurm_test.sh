#!/usr/bin/env bash
# The batch script on a real Slurm: a controller and two nodes on this machine, with keys, ports and
# folders of their own, all gone at the end. Waits for states, never for times.
# Time: two minutes. Exit code 77 where there is no Slurm or no right to start one.
# usage: slurm_test.sh LINKSTUDY TREE
set -u
program=$(readlink -f "$1"); tree=$(readlink -f "$2")

skip() { echo "skipped: $*"; exit 77; }
for command in slurmctld slurmd sbatch munged mpirun unshare; do
  command -v $command >/dev/null || [ -x "/usr/sbin/$command" ] || skip "$command is not installed"
done
[ "$(id -u)" -eq 0 ] || skip "only root can start the nodes"
unshare -u true 2>/dev/null || skip "a node cannot have a name of its own here"
export PATH=$PATH:/usr/sbin

dir=$(mktemp -d /tmp/slurm_test.XXXXXX)
chmod 755 "$dir"
export SLURM_CONF=$dir/slurm.conf TMPDIR=$dir
port=$((20000 + $$ % 20000))
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_pml=ob1
export LINKSTUDY_LANES=1

# Processes of jobs carry our configuration; no other Slurm's do.
own_processes() {
  grep -lsa "SLURM_CONF=$SLURM_CONF" /proc/[0-9]*/environ | cut -d/ -f3 | grep -vx "$$"
}
stop_all() {
  trap - EXIT
  for job in $(squeue -h -o %A 2>/dev/null); do scancel "$job"; done
  for file in "$dir"/slurmd.n1.pid "$dir"/slurmd.n2.pid "$dir"/slurmctld.pid "$dir"/munged.pid; do
    [ ! -s "$file" ] || kill "$(cat "$file")" 2>/dev/null
  done
  for try in 1 2 3 4 5; do
    [ -n "$(own_processes)" ] || break
    [ "$try" -lt 4 ] || kill -KILL $(own_processes) 2>/dev/null
    sleep 0.5
  done
  rm -rf "$dir"
}
trap stop_all EXIT
trap 'exit 1' INT TERM HUP

fail() {
  echo "FAILED: $*"
  tail -n 30 "$dir"/*.out "$dir"/*/linkstudy.log 2>/dev/null
  tail -n 15 "$dir"/slurmctld.log "$dir"/slurmd.*.log 2>/dev/null
  exit 1
}
wait_until() {  # WHAT COMMAND...
  local what=$1 end=$((SECONDS + 100)); shift
  until "$@"; do
    [ $SECONDS -lt $end ] || fail "not within 100 s: $what"
    sleep 0.1
  done
}

# --- Slurm

cat >"$SLURM_CONF" <<END
ClusterName=test
SlurmctldHost=$(hostname)(127.0.0.1)
SlurmctldPort=$port
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$dir/munge.socket,cred_expire=5
CredType=cred/munge
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
ReturnToService=2
KillWait=5
SlurmctldPidFile=$dir/slurmctld.pid
SlurmdPidFile=$dir/slurmd.%n.pid
SlurmctldLogFile=$dir/slurmctld.log
SlurmdLogFile=$dir/slurmd.%n.log
SlurmdSpoolDir=$dir/spool.%n
StateSaveLocation=$dir/state
TmpFS=$dir
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
SlurmdParameters=config_overrides
SchedulerParameters=sched_interval=2,bf_interval=2
NodeName=n[1-2] NodeAddr=127.0.0.1 Port=[$((port + 1))-$((port + 2))] CPUs=4 RealMemory=1000
PartitionName=debug Nodes=n[1-2] Default=YES MaxTime=10 State=UP
END
mkdir "$dir/state" "$dir/spool.n1" "$dir/spool.n2"
dd if=/dev/urandom of="$dir/munge.key" bs=128 count=1 2>/dev/null
chmod 400 "$dir/munge.key"
munged --force --key-file="$dir/munge.key" --socket="$dir/munge.socket" \
  --pid-file="$dir/munged.pid" --log-file="$dir/munged.log" --seed-file="$dir/munge.seed" \
  2>/dev/null || skip "munged does not start"
slurmctld || skip "slurmctld does not start"
for node in n1 n2; do
  unshare -u bash -c "hostname $node; exec slurmd -N $node" || skip "slurmd does not start"
done
both_idle() { [ "$(sinfo -h -t idle -o %D 2>/dev/null)" = 2 ]; }
wait_until "two idle nodes" both_idle

# --- A clone, and a study of 8 evaluations of a second or so

mkdir -p "$dir/clone/jobs" "$dir/clone/build/study" "$dir/elsewhere" "$dir/slow"
cp "$tree/jobs/slurm_study.sbatch" "$dir/clone/jobs"
ln -s "$program" "$dir/clone/build/study/linkstudy"
cp "$tree/configs/mechanisms/rsrrp.toml" "$dir/model.toml"
write_study() {  # FILE END_TIME
  cat >"$dir/$1" <<END
format = 1
kind = "study"
name = "Batch"
model = "model.toml"
reference = { set = { "closure.S.model" = "cut", "simulation.end_time" = 0.2 } }
base = { set = { "closure.S.model" = "sde", "simulation.step" = 1e-4, "simulation.end_time" = $2 } }
[[vary]]
parameter = "closure.S.sde.stiffness"
values = [1e4, 2e4, 3e4, 4e4, 5e4, 6e4, 7e4, 8e4]
[[match]]
signal = "closure.S.force"
tolerance = 0.02
window = [0.05, 0.2]
END
}
write_study short.toml 400.0  # some seconds each: a signal meets runs under way
write_study endless.toml 2e5
cd "$dir/elsewhere" || exit 1

submit() {  # OUT ARGUMENTS OF SBATCH...
  local out=$1; shift
  sbatch --parsable -o "$dir/$out.out" "$@" || fail "sbatch $*"
}
state_of() { scontrol show job "$1" | sed -n 's/^ *JobState=\([A-Z_]*\).*/\1/p'; }
restarts_of() { scontrol show job "$1" | sed -n 's/.* Restarts=\([0-9]*\).*/\1/p'; }
is_over() {
  case $(state_of "$1") in COMPLETED | FAILED | CANCELLED | TIMEOUT | NODE_FAIL) ;; *) false ;; esac
}
exits_with() { scontrol show job "$1" | grep -q " ExitCode=$2:"; }
says() { grep -q -- "$2" "$dir/$1.out"; }
finished() {  # DIR: evaluations done
  "$program" status "$dir/$1" --json 2>/dev/null | sed -n 's/.*"finished":\([0-9]*\).*/\1/p'
}
has_finished() { [ "$(($(finished "$1") + 0))" -ge "$2" ]; }
digest_of() { "$program" status "$dir/$1" --json | sed -n 's/.*"digest":"\([0-9a-f]*\)".*/\1/p'; }
has_begun() { grep -q "reference run took" "$dir/$1/linkstudy.log" 2>/dev/null; }
is_requeued() { [ "$(restarts_of "$1")" -ge "$2" ]; }
script=$dir/clone/jobs/slurm_study.sbatch

# The wall time comes from squeue: this job of a minute ends by itself. It goes on beside the rest.
limited=$(LINKSTUDY_LEAD=1 submit limited -n 1 --time 1 --signal=B:USR1@1 \
  "$script" study "$dir/endless.toml" "$dir/limited")

# Refused at once, with the reason.
too_short=$(submit too_short -n 1 --time 1 "$script" study "$dir/short.toml" "$dir/refused")
missing=$(LINKSTUDY=$dir/nowhere submit missing -n 1 --time 5 \
  "$script" study "$dir/short.toml" "$dir/refused")
bare=$(submit bare -n 3 --time 5 --wrap "$program study $dir/short.toml -o $dir/refused")
for job in "$too_short" "$missing" "$bare"; do wait_until "job $job ends" is_over "$job"; done
exits_with "$too_short" 2 && says too_short "Slurm asks to end 120 s before" ||
  fail "a limit shorter than the lead is taken"
exits_with "$missing" 2 && says missing "there is no program $dir/nowhere" ||
  fail "a missing program is not named"
exits_with "$bare" 2 && says bare "gave this job 3 tasks" || fail "one of three tasks runs alone"
[ ! -e "$dir/refused" ] || fail "a refused job writes"
echo "ok: refused are a short limit, a missing program, one process for three tasks"

# A signal while mpirun is still on its way is kept for the ranks.
cat >"$dir/slow/mpirun" <<END
#!/bin/sh
touch "$dir/slow/begun"
until [ -e "$dir/slow/go" ]; do sleep 0.1; done
exec $(command -v mpirun) "\$@"
END
chmod +x "$dir/slow/mpirun"
early=$(PATH=$dir/slow:$PATH submit early -n 1 --time 5 \
  "$script" study "$dir/short.toml" "$dir/early")
wait_until "mpirun begins" test -e "$dir/slow/begun"
scancel -b -s USR1 "$early"
sleep 0.5
touch "$dir/slow/go"
wait_until "the early signal ends the job, which is requeued" is_requeued "$early" 1
scancel "$early"
says early "exit code 75, resumable" || fail "the early signal is lost"
echo "ok: a signal before the ranks are up is not lost"

# scancel cancels what is in flight and does not requeue.
cancelled=$(submit cancelled -n 2 --time 5 "$script" study "$dir/endless.toml" "$dir/cancelled")
wait_until "the study has begun" has_begun cancelled
scancel "$cancelled"
wait_until "the job ends" is_over "$cancelled"
wait_until "the script has its say" says cancelled "cancelled (exit code"
wait_until "the log has the signal" grep -q "stop signal .*cancelled" "$dir/cancelled/linkstudy.log"
[ "$(state_of "$cancelled")" = CANCELLED ] || fail "a cancelled job is $(state_of "$cancelled")"
is_kept() {
  "$program" status "$dir/cancelled" --json | grep -q '"state":"interrupted".*"references":1'
}
wait_until "what was done before scancel is kept" is_kept
echo "ok: scancel cancels in order, and for good"

# Two nodes; interrupted by the user, then by the loss of a node; --fresh, which erases once only.
whole=$("$program" study "$dir/short.toml" -o "$dir/whole" --progress none 2>/dev/null | tail -n 1)
cp -r "$dir/whole" "$dir/long"  # what --fresh is to erase
long=$(submit long -N 2 -n 3 --time 5 "$script" study "$dir/short.toml" "$dir/long" --fresh)
wait_until "the study has begun afresh" grep -q "Slurm job $long" "$dir/long/linkstudy.log"
wait_until "something is done" has_finished long 1
scancel -b -s USR1 "$long"
wait_until "the job is requeued" is_requeued "$long" 1
before=$(finished long)
wait_until "the second start" grep -q "Slurm job $long, restart 1" "$dir/long/linkstudy.log"
[ "$(finished long)" -ge "$before" ] || fail "--fresh erased what the first start did"
says long "fresh was for the first start" || fail "--fresh is passed over in silence"
[ "$(grep -c "reference run took" "$dir/long/linkstudy.log")" -eq 2 ] ||
  fail "the reference is run again"  # once by hand, once by the first start
if [ "$before" -lt 8 ]; then
  lost=$(for id in $(own_processes); do
    if [ "$(cat "/proc/$id/comm" 2>/dev/null)" = orted ]; then echo "$id"; fi
  done)
  [ -n "$lost" ] || fail "the second node has no orted"
  kill -KILL $lost
  wait_until "the job is requeued after the loss of a node" is_requeued "$long" 2
  says long "exit code 205, resumable" || fail "not requeued by the script"
fi
wait_until "the job ends" is_over "$long"
exits_with "$long" 0 || fail "the requeued job ends with another code than 0"
[ "results digest: $(digest_of long)" = "$whole" ] || fail "another digest than without Slurm"
"$program" status "$dir/long" --json | grep -q '"state":"complete"' || fail "not complete"
echo "ok: interrupted, a node lost, requeued twice: the digest of the undisturbed run"

# A folder of four files on two nodes, interrupted.
write_folder() {  # FOLDER
  mkdir "$dir/$1"
  cp "$dir/model.toml" "$dir/$1"
  for name in a b c d; do write_study "$1/$name.toml" 100.0; done
}
are_whole() {  # FOLDER
  for name in a b c d; do
    [ "results digest: $(digest_of "$1/results/$name")" = "$part" ] ||
      fail "$1/$name: another digest"
  done
}
begins() { cat "$dir/$1".out 2>/dev/null | grep -c " begins$"; }
write_folder folder
write_folder shared
part=$("$program" study "$dir/folder/a.toml" -o "$dir/part" --progress none 2>/dev/null | tail -n 1)
queue=$(submit queue -N 2 -n 3 --time 5 "$script" queue "$dir/folder")
wait_until "something of the second file is done" has_finished folder/results/b 1
scancel -b -s USR1 "$queue"
wait_until "the queue is requeued" is_requeued "$queue" 1
says queue "exit code 75, resumable: job $queue goes back" || fail "not requeued by the script"
wait_until "the queue ends" is_over "$queue"
exits_with "$queue" 0 || fail "the requeued queue ends with another code than 0"
are_whole folder
[ "$(grep -c "a begins" "$dir/queue.out")" -eq 1 ] || fail "a file that has ended is run again"
echo "ok: a folder on two nodes, requeued: the digests of undisturbed runs"

# Two tasks of an array share a folder, and one of them is requeued without the other.
array=$(submit "shared_%a" --array=1-2 -n 2 --time 5 "$script" queue "$dir/shared")
both_work() { has_finished shared/results/a 1 && has_finished shared/results/b 1; }
wait_until "both tasks have a file" both_work
scancel -b -s USR1 "${array}_2"
wait_until "one task is requeued" is_requeued "${array}_2" 1
for task in "${array}_1" "${array}_2"; do
  wait_until "task $task ends" is_over "$task"
  exits_with "$task" 0 || fail "task $task ends with another code than 0"
done
[ "$(restarts_of "${array}_1")" -eq 0 ] || fail "the other task is requeued, too"
are_whole shared
one=$(begins shared_1); two=$(begins shared_2)
[ "$one" -gt 0 ] && [ "$two" -gt 0 ] || fail "one task did all"
[ $((one + two)) -eq 5 ] || fail "a file is run twice"
echo "ok: an array shares a folder, each task is requeued by itself"

wait_until "the job of a minute is requeued before its limit" is_requeued "$limited" 1
scancel "$limited"
grep -q "interrupted: wall time" "$dir/limited/linkstudy.log" || fail "not ended by the wall time"
says limited "exit code 75, resumable" || fail "the job of a minute is not requeued by the script"
echo "ok: the wall time comes from Slurm"
