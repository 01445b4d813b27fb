#include "study/tune/lockstep.h"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace linkstudy::tuning {
namespace {

// Ends a search whose question cannot be answered any more.
class LockstepStopped : public std::runtime_error {
 public:
  LockstepStopped() : std::runtime_error("the evaluations have ended") {}
};

enum class SeatState { runs, asks, ended };

struct Seat {
  SeatState state = SeatState::runs;
  const std::vector<Request>* requests = nullptr;
  std::vector<Answer> answers;
  std::exception_ptr error;
};

class Lockstep {
 public:
  Lockstep(const EvaluateBatch& evaluate, const std::vector<LockstepSearch>& searches)
      : evaluate_(evaluate), seats_(searches.size()) {
    for (std::size_t i = 0; i < searches.size(); ++i) {
      threads_.emplace_back([this, i, &search = searches[i]] { run_seat(seats_[i], search); });
    }
  }

  void run() {
    while (answer_round()) {
    }
    threads_.clear();  // joins
    if (failure_) std::rethrow_exception(failure_);
    for (const Seat& seat : seats_)
      if (seat.error) std::rethrow_exception(seat.error);
  }

 private:
  void run_seat(Seat& seat, const LockstepSearch& search) {
    try {
      search([this, &seat](const std::vector<Request>& requests) { return ask(seat, requests); });
    } catch (...) {
      seat.error = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    seat.state = SeatState::ended;
    changed_.notify_all();
  }

  std::vector<Answer> ask(Seat& seat, const std::vector<Request>& requests) {
    std::unique_lock lock(mutex_);
    seat.requests = &requests;
    seat.state = SeatState::asks;
    changed_.notify_all();
    changed_.wait(lock, [&] { return seat.state == SeatState::runs; });
    if (failure_) throw LockstepStopped();
    return std::move(seat.answers);
  }

  // Returns false when every search has ended.
  bool answer_round() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] {
      return std::ranges::none_of(seats_, [](const Seat& s) { return s.state == SeatState::runs; });
    });
    std::vector<Seat*> asking;
    for (Seat& seat : seats_)
      if (seat.state == SeatState::asks) asking.push_back(&seat);
    if (asking.empty()) return false;
    if (!failure_) answer(asking);
    for (Seat* seat : asking) seat->state = SeatState::runs;
    changed_.notify_all();
    return true;
  }

  // All threads wait meanwhile.
  void answer(const std::vector<Seat*>& asking) {
    std::map<std::pair<std::vector<double>, double>, std::size_t> places;
    std::vector<Request> merged;
    for (const Seat* seat : asking) {
      for (const Request& request : *seat->requests) {
        const bool is_new =
            places.emplace(std::pair(request.x, request.step_factor), merged.size()).second;
        if (is_new) merged.push_back(request);
      }
    }
    try {
      const std::vector<Answer> answers = evaluate_(merged);
      for (Seat* seat : asking) {
        seat->answers.clear();
        for (const Request& request : *seat->requests) {
          seat->answers.push_back(answers.at(places.at({request.x, request.step_factor})));
        }
      }
    } catch (...) {
      failure_ = std::current_exception();
    }
  }

  const EvaluateBatch& evaluate_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Seat> seats_;
  std::exception_ptr failure_;
  std::vector<std::jthread> threads_;  // last: joined before the rest goes
};

}  // namespace

void run_in_lockstep(const EvaluateBatch& evaluate, const std::vector<LockstepSearch>& searches) {
  Lockstep(evaluate, searches).run();
}

}  // namespace linkstudy::tuning
