// What the long verbs share: the same steps on every rank, with a gate after each, so that all
// ranks leave together with one exit code and only rank 0 speaks.
//   read the input -> open the results directory (rank 0) -> run the references -> hand out work
#pragma once

#include <functional>

#include "study/schedule/transport.h"
#include "study/session/session.h"

namespace linkstudy {

// Every rank reads; throws what describe_failure (session/failure.h) knows.
using ReadInput = std::function<StudyInput()>;
// Runs on rank 0 and returns the exit code.
using SessionWork = std::function<int(StudySession& session)>;

int run_session(const SessionOptions& options, const ReadInput& read, const SessionWork& work);
// One of several by the same ranks, until the deadline of them all.
int run_session(Transport& transport, const RunDeadline& deadline, const SessionOptions& options,
                const ReadInput& read, const SessionWork& work);

// Runs a step on every rank and agrees on how it ended: the exit code. What rank 0 has to say is
// said by it alone; what went wrong on another rank only, by that one.
int pass_gate(Transport& transport, const std::function<int()>& step);

// "linkstudy 1.2 abc, 2 ranks on 1 node, SIMD ..., kernels ...": the banner.
std::string ranks_text(const Transport& transport);

// Of all ranks, once: the transport, and from when on signals are taken. `run` has what is thrown
// on one rank alone end all others.
int run_on_ranks(const std::function<int(Transport& transport)>& run);

}  // namespace linkstudy
