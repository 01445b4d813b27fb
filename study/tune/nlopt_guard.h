// Calls that NLopt makes: nothing may leave through the frames of its C code, so what is thrown
// stops the optimiser and is thrown again once it has returned.
#pragma once

#include <exception>
#include <nlopt.hpp>

namespace linkstudy {

class NloptGuard {
 public:
  explicit NloptGuard(nlopt::opt& opt) : opt_(opt) {}

  template <class Step>
  void run(const Step& step) noexcept {
    try {
      step();
    } catch (...) {
      if (!error_) error_ = std::current_exception();
      stop();
    }
  }

  void stop() { opt_.force_stop(); }
  bool has_failed() const { return error_ != nullptr; }

  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  nlopt::opt& opt_;
  std::exception_ptr error_;
};

}  // namespace linkstudy
