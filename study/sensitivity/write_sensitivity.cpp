#include "study/sensitivity/write_sensitivity.h"

#include <nlohmann/json.hpp>

#include "study/record/json_number.h"

namespace linkstudy::sensitivity {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Estimate& estimate) {
  return {{"value", json_number(estimate.value)},
          {"low", json_number(estimate.interval.low)},
          {"high", json_number(estimate.interval.high)},
          {"finding", name_of(estimate.finding)},
          {"blocks_needed", json_number(estimate.needed)}};
}

Json json_of(const Sensitivity& result, const ParameterSensitivity& own) {
  const bool is_morris = result.design == Design::morris;
  Json json = {{"parameter", result.parameters[own.parameter].path},
               {is_morris ? "mu" : "first", json_of(own.main)},
               {is_morris ? "mu_star" : "total", json_of(own.total)}};
  if (is_morris) json["sigma"] = json_number(own.sigma);
  return json;
}

Json json_of(const Sensitivity& result, const QuantitySensitivity& quantity) {
  Json parameters = Json::array();
  for (const ParameterSensitivity& own : quantity.parameters) {
    parameters.push_back(json_of(result, own));
  }
  return {{"name", quantity.name},
          {"unit", quantity.unit},
          {"blocks", quantity.blocks},
          {"left_out", quantity.left_out},
          {"mean", json_number(quantity.mean)},
          {"deviation", json_number(quantity.deviation)},
          {"parameters", std::move(parameters)}};
}

Json json_of(const Spread& spread) {
  return {{"low", json_number(spread.low)},
          {"median", json_number(spread.median)},
          {"high", json_number(spread.high)}};
}

}  // namespace

std::string write_json(const Sensitivity& result) {
  Json quantities = Json::array();
  for (const QuantitySensitivity& one : result.quantities) {
    quantities.push_back(json_of(result, one));
  }
  Json failures = Json::array();
  for (const FailureRegion& one : result.failures) {
    failures.push_back({{"cause", name_of(one.cause)},
                        {"parameter", result.parameters[one.parameter].path},
                        {"failed", one.count},
                        {"failed_values", json_of(one.failed)},
                        {"ok", one.ok},
                        {"ok_values", json_of(one.ran)},
                        {"separation", json_number(one.separation)}});
  }
  const Json json = {{"method", name_of(result.design)},
                     {"quantities", std::move(quantities)},
                     {"failures", std::move(failures)}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace linkstudy::sensitivity
