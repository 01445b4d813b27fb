// Which ranks still work, told by what rank 0 hears of them. A rank is called about once a second
// and answers from its main thread, whatever its compute thread does; the answer says whether that
// has gone on since the last one. So slow and frozen are told apart:
//   silent   no message at all for   D = 60 s, or 5 s + T where one task may take T (--timeout)
//                                        and that is shorter
//   stuck    answers, but the compute thread does not go on for   max(10 D, 20 x longest task)
// Either is lost: it gets no more work, and what it had goes elsewhere. Time in which rank 0 itself
// stood still (a suspended job) counts for nobody.
#pragma once

#include <chrono>
#include <cstddef>
#include <vector>

namespace linkstudy {

class RankWatch {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // task_limit_s: longest time of a task, 0 where there is no limit.
  RankWatch(int ranks, double task_limit_s, Time now);

  // A message came from a rank; `goes_on`: its compute thread is idle or has gone on.
  void hear(int rank, bool goes_on);
  void note_task(double seconds);

  // Time is counted from now on: nobody was called before.
  void restart(Time now);
  // Ranks that are lost from now on.
  std::vector<int> find_lost(Time now);
  // True about once a second: call the ranks.
  bool is_time_to_call(Time now);

  bool is_lost(int rank) const { return states_[static_cast<std::size_t>(rank)].lost; }
  int lost_count() const { return lost_count_; }
  // Of a lost rank, how long it had been silent or stuck.
  double silence_s(int rank) const;
  bool answers(int rank) const;

  double silent_limit_s() const { return silent_limit_s_; }
  double stuck_limit_s() const;

 private:
  struct State {
    double silent_s = 0.0;
    double stuck_s = 0.0;
    bool lost = false;
  };

  std::vector<State> states_;
  double silent_limit_s_;
  double longest_task_s_ = 0.0;
  int lost_count_ = 0;
  Time counted_;
  Time called_;
};

}  // namespace linkstudy
