// What an exception means to the user: a text for standard error and an exit code.
#pragma once

#include <exception>
#include <string>

namespace linkstudy {

struct Failure {
  int code = 0;
  std::string text;  // ends in a newline; empty when another process says it
};

Failure describe_failure(const std::exception_ptr& error);

}  // namespace linkstudy
