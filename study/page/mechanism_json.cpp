#include "study/page/mechanism_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/topology/linkage_words.h"
#include "study/record/base64.h"

namespace linkstudy {
namespace {

using Json = nlohmann::ordered_json;

void append_pose(std::vector<double>& numbers, const ShortenedDualQuaternion& pose) {
  numbers.insert(numbers.end(), {pose.r.x(), pose.r.y(), pose.r.z()});
  numbers.insert(numbers.end(), {pose.e[0], pose.e[1], pose.e[2], pose.e[3]});
}

Json frame_of(const Frame& frame) {
  std::vector<double> numbers;
  append_pose(numbers, {euler_parameters(frame.rotation), frame.position});
  return numbers;
}

Json vector_of(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

Json solid_of(const Solid& solid) {
  Json json = {{"kind", name_of(solid.kind)}};
  switch (solid.kind) {
    case SolidKind::cylinder:
      json["begin"] = vector_of(solid.begin);
      json["end"] = vector_of(solid.end);
      json["diameter"] = solid.diameter;
      break;
    case SolidKind::box:
      json["sides"] = vector_of(solid.sides);
      json["frame"] = frame_of(solid.frame);
      break;
    case SolidKind::sphere:
      json["diameter"] = solid.diameter;
      json["frame"] = frame_of(solid.frame);
      break;
  }
  return json;
}

Json shape_of(const Link& link) {
  Json solids = Json::array();
  for (const Solid& solid : link.shape) solids.push_back(solid_of(solid));
  return solids;
}

bool is_loose(const Closure& closure) {
  return closure.model == ClosureModel::clearance;
}

class Scene {
 public:
  explicit Scene(const MovingRun& run) : run_(run) {}

  Json make() const {
    std::vector<double> poses;
    for (const ShortenedDualQuaternion& pose : run_.poses) append_pose(poses, pose);
    return {{"title", run_.title},
            {"load_case", run_.load_case},
            {"history", run_.histories.name},
            {"ended", run_.ended},
            {"driven", run_.driven},
            {"links", links()},
            {"joints", joints()},
            {"closures", closures()},
            {"springs", springs()},
            {"points", points()},
            {"times", base64_floats(run_.times)},
            {"poses", base64_floats(poses)}};
  }

 private:
  std::ptrdiff_t number_of(const std::string& link) const {
    return std::ranges::find(run_.links, link) - run_.links.begin();
  }

  Json links() const {
    Json all = Json::array();
    for (const std::string& name : run_.links) {
      const auto link = std::ranges::find(run_.linkage.links, name, &Link::name);
      const bool is_ground = link == run_.linkage.links.end();
      all.push_back({{"name", name},
                     {"mass", is_ground ? Json(nullptr) : Json(link->mass)},
                     {"center", is_ground ? Json(nullptr) : vector_of(link->center_of_mass)},
                     {"shape", is_ground ? Json::array() : shape_of(*link)}});
    }
    return all;
  }

  Json joints() const {
    Json all = Json::array();
    for (const Joint& joint : run_.linkage.joints) {
      all.push_back({{"name", joint.name},
                     {"type", name_of(joint.type)},
                     {"parent", number_of(joint.parent)},
                     {"child", number_of(joint.child)},
                     {"parent_frame", frame_of(joint.frame)},
                     {"child_frame", frame_of(joint.child_frame)},
                     {"bends", joint.elastic}});
    }
    return all;
  }

  Json closures() const {
    Json all = Json::array();
    for (const Closure& closure : run_.linkage.closures) {
      all.push_back({{"name", closure.name},
                     {"type", name_of(closure.type)},
                     {"model", name_of(closure.model)},
                     {"radial", is_loose(closure) ? Json(closure.clearance.radial) : Json(nullptr)},
                     {"first", number_of(closure.first.link)},
                     {"second", number_of(closure.second.link)},
                     {"first_frame", frame_of(closure.first.frame)},
                     {"second_frame", frame_of(closure.second.frame)}});
    }
    return all;
  }

  Json springs() const {
    Json all = Json::array();
    for (const PointSpring& spring : run_.linkage.springs) {
      all.push_back({{"name", spring.name},
                     {"first", number_of(spring.first.link)},
                     {"second", number_of(spring.second.link)},
                     {"first_position", vector_of(spring.first.position)},
                     {"second_position", vector_of(spring.second.position)}});
    }
    return all;
  }

  Json points() const {
    Json all = Json::array();
    for (const ChosenPoint& point : run_.linkage.points) {
      all.push_back({{"name", point.name},
                     {"link", number_of(point.link)},
                     {"position", vector_of(point.position)}});
    }
    return all;
  }

  const MovingRun& run_;
};

}  // namespace

Json mechanism_json(const MovingRun& run) {
  return Scene(run).make();
}

}  // namespace linkstudy
