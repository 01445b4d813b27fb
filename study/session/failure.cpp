#include "study/session/failure.h"

#include <fmt/format.h>

#include "core/base/isa.h"
#include "study/config/input_error.h"
#include "study/evaluate/evaluator.h"
#include "study/report/console.h"
#include "study/schedule/launcher.h"
#include "study/session/exit_code.h"
#include "study/store/store_error.h"

namespace linkstudy {
namespace {

Failure make_failure(int code, const std::string& message) {
  return {code, fmt::format("linkstudy: error: {}\n", message)};
}

}  // namespace

Failure describe_failure(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const InputError& input) {
    return {kInputError, to_string(input.diagnostics())};
  } catch (const LaunchError& launch) {
    if (!launch.is_first()) return {kInputError, ""};
    return make_failure(kInputError, launch.what());
  } catch (const UsageError& usage) {
    return make_failure(kInputError, usage.what());
  } catch (const SimdError& simd) {
    return make_failure(kInputError, simd.what());
  } catch (const StoreError& store) {
    return make_failure(kInputError, store.what());
  } catch (const OutputError& output) {
    return make_failure(kInternalError, output.what());
  } catch (const ReferenceFailure& reference) {
    return make_failure(kTooManyFailed, reference.what());
  } catch (const std::exception& other) {
    return make_failure(kInternalError, fmt::format("internal: {}", other.what()));
  } catch (...) {
    return make_failure(kInternalError, "internal: an unknown exception");
  }
}

}  // namespace linkstudy
