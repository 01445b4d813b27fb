// SIGTERM, SIGUSR1 and SIGINT ask for an orderly end instead of killing: the handler only counts.
// Level 0: go on. Level 1: hand out no more work, wait for what is running. Level 2 (a second
// signal): return at once with what has arrived. Signals within 100 ms count once, because a
// launcher and a terminal both pass on the same key press.
//
// SIGCONT is only noted: a launcher that ends a job sends it ahead of SIGTERM, and SIGKILL follows.
#pragma once

namespace linkstudy {

// Interrupted, and to be started again: the exit code for which a queue requeues the job.
inline constexpr int exit_resumable = 75;

// Handlers are installed from construction on. They stay when it goes, since a launcher may still
// send SIGTERM to a rank that is on its way out; one object per process, first thing in main.
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

// Raises the level as a signal does, without the 100 ms.
void request_stop();

void reset_stop();

}  // namespace linkstudy
