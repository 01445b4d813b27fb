// Works on the entries of a folder, one after the other and in the order of their names, until none
// is left that could be begun. Any number of programs may share the folder: an entry belongs to
// whoever holds its lock, and one whose holder was killed is gone on with.
//
// What has ended stays so until its input reads differently, but what was refused is tried once by
// every start; a file that is written anew, or comes later, is taken as well. With a deadline
// nothing is begun that cannot end in time (enough_time.h) but would in another allocation of the
// same length; what would not is begun when nothing else is left, and goes on in the next.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "study/queue/queue_folder.h"
#include "study/schedule/transport.h"
#include "study/session/deadline.h"

namespace linkstudy {

struct StudyInput;

}  // namespace linkstudy

namespace linkstudy::queue {

struct EntryAnswer {
  int code = 0;         // exit code
  std::string verdict;  // rank 0
};

using OnEnd = std::function<void(const EntryAnswer& answer)>;

struct DrainWork {
  // Rank 0: the input as the run will read it. Throws what describe_failure knows.
  std::function<StudyInput(const Entry& entry)> read;
  // Rank 0: what results of the input are of (input_sha256).
  std::function<std::string(const StudyInput& input, Transport& ranks)> identify;
  // All ranks; the exit code. Rank 0 calls `end` when all is written: its ranks may not come back,
  // where one of them is lost.
  std::function<int(const Entry& entry, Transport& ranks, const OnEnd& end)> run;
};

struct DrainOptions {
  std::filesystem::path folder;
  RunDeadline deadline;
  double wait_s = 0.0;   // for further entries, when none is left
  bool retries = false;  // entries that ended before this start are begun once more
  std::string name;      // of these ranks, in front of what they say; may be empty
};

// All ranks of the transport. Returns the gravest exit code of all entries, whenever they ended:
// kExitResumable where something was interrupted, or is left for another allocation.
int drain(Transport& ranks, const DrainOptions& options, const DrainWork& work);

}  // namespace linkstudy::queue
