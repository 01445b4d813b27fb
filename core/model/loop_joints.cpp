#include "core/model/loop_joints.h"

#include <algorithm>
#include <numeric>

#include "core/model/closure_rows.h"
#include "core/model/walk.h"

namespace linkstudy {
namespace {

// A joint that holds something between two bodies.
struct Edge {
  BodyIndex a, b;
  LoopJoint joint;
};

const Joint& joint_named(const Linkage& linkage, const std::string& name) {
  return *std::find_if(linkage.joints.begin(), linkage.joints.end(),
                       [&](const Joint& joint) { return joint.name == name; });
}

std::vector<Edge> holding_joints(const Linkage& linkage, const Mechanism& m) {
  std::vector<Edge> edges;
  for (const BodyIndex b : bodies_outwards(m)) {
    const Joint& joint = joint_named(linkage, m.joint_names[b]);
    if (joint.type == JointType::free) continue;
    edges.push_back({m.bodies[b].parent, b, {.body = b, .counts = !joint.elastic}});
  }
  for (const ClosureIndex i : indices_of(m.closures)) {
    const ClosureStructure& c = m.closures[i];
    if (storage_of(c.model) != RowStorage::cut || c.first == c.second) continue;
    edges.push_back({c.first, c.second, {.closure = i}});
  }
  return edges;
}

// Sets that grow together; the least member stands for all.
class Sets {
 public:
  explicit Sets(std::size_t count) : least_(count) {
    std::iota(least_.begin(), least_.end(), std::size_t{0});
  }
  std::size_t of(std::size_t i) const {
    while (least_[i] != i) i = least_[i];
    return i;
  }
  void join(std::size_t i, std::size_t k) {
    const auto [low, high] = std::minmax({of(i), of(k)});
    least_[high] = low;
  }

 private:
  std::vector<std::size_t> least_;
};

// Grows a spanning forest edge by edge. An edge between bodies that are connected already closes a
// loop, whose edges belong together; blocks are what such loops, with edges in common, cover.
class Forest {
 public:
  Forest(const std::vector<Edge>& edges, std::size_t bodies)
      : edges_(edges), bodies_(bodies), neighbours_(bodies), blocks_(edges.size()) {
    for (std::size_t i = 0; i < edges.size(); ++i) add(i);
  }

  std::size_t block_of(std::size_t edge) const { return blocks_.of(edge); }

 private:
  void add(std::size_t i) {
    const auto a = static_cast<std::size_t>(edges_[i].a.value());
    const auto b = static_cast<std::size_t>(edges_[i].b.value());
    if (bodies_.of(a) == bodies_.of(b)) {
      join_way(a, b, nobody, i);
      return;
    }
    bodies_.join(a, b);
    neighbours_[a].push_back({b, i});
    neighbours_[b].push_back({a, i});
  }

  // Joins edge `closing` with those of the way through the forest; false where there is none.
  bool join_way(std::size_t from, std::size_t to, std::size_t before, std::size_t closing) {
    if (from == to) return true;
    for (const auto& [next, edge] : neighbours_[from]) {
      if (next == before || !join_way(next, to, from, closing)) continue;
      blocks_.join(edge, closing);
      return true;
    }
    return false;
  }

  static constexpr auto nobody = static_cast<std::size_t>(-1);

  const std::vector<Edge>& edges_;
  Sets bodies_;
  std::vector<std::vector<std::pair<std::size_t, std::size_t>>> neighbours_;  // body, edge
  Sets blocks_;
};

}  // namespace

void add_loop_joints(const Linkage& linkage, Mechanism& m) {
  const std::vector<Edge> edges = holding_joints(linkage, m);
  const Forest forest(edges, m.bodies.size());
  std::vector<int> size(edges.size(), 0);
  for (std::size_t i = 0; i < edges.size(); ++i) ++size[forest.block_of(i)];
  m.loop_joints.clear();
  m.loop_rows.clear();
  for (const bool counts : {true, false}) {
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const std::size_t block = forest.block_of(i);
      if (edges[i].joint.counts != counts || size[block] == 1) continue;
      m.loop_joints.push_back(edges[i].joint);
      m.loop_joints.back().group = static_cast<int>(block);
    }
  }
  for (const ClosureIndex i : indices_of(m.closures)) {
    if (storage_of(m.closures[i].model) != RowStorage::cut) continue;
    const auto rows = make_cut_rows(linkage.closures[static_cast<std::size_t>(i.value())], i, 0u);
    m.loop_rows.insert(m.loop_rows.end(), rows.begin(), rows.end());
  }
}

}  // namespace linkstudy
