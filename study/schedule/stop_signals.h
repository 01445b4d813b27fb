// Signals that ask for an orderly end instead of killing: the handlers only raise a level.
//   0        go on
//   finish   hand out no more work, wait for what is in flight: the first SIGUSR1 or SIGINT
//   cancel   end what is in flight at once, write, leave: SIGTERM, SIGHUP, SIGUSR2, or a second
//            SIGUSR1 or SIGINT
// A launcher kills one second after its own SIGTERM, so nothing may be waited for then. SIGUSR2 is
// the one that mpirun passes on like SIGUSR1, leaving the exit code to its ranks. SIGUSR1 and
// SIGINT within 100 ms count once, because a launcher and a terminal both pass on one key press.
//
// SIGCONT is only noted: a launcher that ends a job sends it ahead of SIGTERM, and SIGKILL follows.
#pragma once

namespace linkstudy {

// Interrupted, and to be started again: the exit code for which a queue requeues the job.
inline constexpr int kExitResumable = 75;

inline constexpr int kStopFinish = 1;
inline constexpr int kStopCancel = 2;

// Handlers are installed from construction on. They stay when it goes, since a launcher may still
// send SIGTERM to a rank that is on its way out; one object per process, first thing in main. A
// SIGHUP that is ignored (nohup) stays ignored.
class StopSignals {
 public:
  StopSignals();
};

int stop_level();

// The signal that was counted last, 0 when there was none or a request.
int last_stop_signal();

// True after SIGCONT and SIGTERM in this order: the launcher is ending the job and no longer helps
// its ranks to finalize (mpirun's MPI_Finalize then hangs until SIGKILL).
bool job_is_dying();

// Raises the level as SIGUSR1 does, without the 100 ms.
void request_stop();

void reset_stop();

}  // namespace linkstudy
