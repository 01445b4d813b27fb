// Loops over the bodies, closures, rows and loads of a mechanism: see core/base/walk.h.
#pragma once

#include "core/base/walk.h"
#include "core/model/mechanism.h"

namespace linkstudy {

template <class M>
inline auto body_count(const M& m) {
  return structural(m, 0, [](const auto& s, int) { return static_cast<int>(s.bodies.size()); });
}
template <class M>
inline auto cut_row_count(const M& m) {
  return structural(m, 0, [](const auto& s, int) { return static_cast<int>(s.cut_rows.size()); });
}
template <class M>
inline auto sde_row_count(const M& m) {
  return structural(m, 0, [](const auto& s, int) { return static_cast<int>(s.sde_rows.size()); });
}

// Bodies other than ground, parents first or last.
template <class M, class F>
inline void for_bodies(const M& m, F&& f) {
  for_range(Index<1>(), body_count(m), f);
}
template <class M, class F>
inline void for_bodies_inwards(const M& m, F&& f) {
  for_range_down(Index<1>(), body_count(m), f);
}

// The body and all bodies between it and ground.
template <class M, class B, class F>
inline void for_bodies_to_ground(const M& m, B b, F&& f) {
  if constexpr (Constant<B>) {
    if constexpr (B::value > 0) {
      f(b);
      for_bodies_to_ground(m, Index<M::bodies[static_cast<std::size_t>(B::value)].parent>(), f);
    }
  } else {
    for (int i = b; i > 0; i = at(m.bodies, i).parent) f(i);
  }
}

// True if `end` is the body or lies outboard of it.
template <class M>
[[gnu::always_inline]] inline bool carries(const M& m, int body, int end) {
  while (end > body) end = at(m.bodies, end).parent;
  return end == body;
}

template <class M, class B, class F>
inline void for_stages(const M& m, B b, F&& f) {
  for_range(structural(m, b, [](const auto& s, int i) { return at(s.bodies, i).stage_begin; }),
            structural(m, b, [](const auto& s, int i) { return at(s.bodies, i).stage_end; }), f);
}

template <class M, class F>
inline void for_all_stages(const M& m, F&& f) {
  const auto count =
      structural(m, 0, [](const auto& s, int) { return static_cast<int>(s.stages.size()); });
  for_range(Index<0>(), count, f);
}

// Velocities of one joint.
template <class M, class B, class F>
inline void for_velocities_of(const M& m, B b, F&& f) {
  for_range(structural(m, b, [](const auto& s, int i) { return at(s.bodies, i).v_begin; }),
            structural(m, b,
                       [](const auto& s, int i) {
                         return at(s.bodies, i).v_begin + at(s.bodies, i).v_count;
                       }),
            f);
}

template <class M, class K>
inline auto body_of(const M& m, K k) {
  return structural(m, k, [](const auto& s, int i) { return at(s.velocities, i).body; });
}
template <class M, class B>
inline auto parent_of(const M& m, B b) {
  return structural(m, b, [](const auto& s, int i) { return at(s.bodies, i).parent; });
}

// Clearances keep multipliers for the directions that stay blocked: their rows are cut rows.
constexpr bool has_cut_rows(ClosureModel model) {
  return model != ClosureModel::sde;
}

// Closures whose rows are cut rows, or sde rows.
template <ClosureModel Model, class M, class F>
inline void for_closures(const M& m, F&& f) {
  const auto count =
      structural(m, 0, [](const auto& s, int) { return static_cast<int>(s.closures.size()); });
  for_range(Index<0>(), count, [&](auto c) {
    if constexpr (Constant<decltype(c)>) {
      constexpr ClosureModel model = M::closures[static_cast<std::size_t>(c())].model;
      if constexpr (has_cut_rows(model) == has_cut_rows(Model)) f(c);
    } else {
      if (has_cut_rows(at(m.closures, c).model) == has_cut_rows(Model)) f(c);
    }
  });
}

template <class M, class C>
inline auto row_begin(const M& m, C c) {
  return structural(m, c, [](const auto& s, int i) { return at(s.closures, i).row_begin; });
}
template <class M, class C>
inline auto row_end(const M& m, C c) {
  return structural(m, c, [](const auto& s, int i) { return at(s.closures, i).row_end; });
}

// Rows of a closure; `for_other_rows` leaves out the three ground axes treated together.
template <class M, class C, class F>
inline void for_rows(const M& m, C c, F&& f) {
  for_range(row_begin(m, c), row_end(m, c), f);
}
template <class M, class C, class F>
inline void for_other_rows(const M& m, C c, F&& f) {
  for_range(structural(m, c,
                       [](const auto& s, int i) {
                         return at(s.closures, i).row_begin +
                                (at(s.closures, i).point_rows ? 3 : 0);
                       }),
            row_end(m, c), f);
}

// Velocities that move a point of the first or the second body of a closure.
template <class M, class C, class F>
inline void for_path_of_first(const M& m, C c, F&& f) {
  for_path(m, structural(m, c, [](const auto& s, int i) { return at(s.closures, i).last_1; }), f);
}
template <class M, class C, class F>
inline void for_path_of_second(const M& m, C c, F&& f) {
  for_path(m, structural(m, c, [](const auto& s, int i) { return at(s.closures, i).last_2; }), f);
}

// Velocities of both paths of a closure, each once, last first.
template <class M, class C, class F>
inline void for_support(const M& m, C c, F&& f) {
  const auto begin =
      structural(m, c, [](const auto& s, int i) { return at(s.closures, i).support_begin; });
  const auto end =
      structural(m, c, [](const auto& s, int i) { return at(s.closures, i).support_end; });
  for_range(begin, end, [&](auto i) {
    f(structural(m, i, [](const auto& s, int n) { return at(s.support, n); }));
  });
}

template <class M, class F>
inline void for_joint_springs(const M& m, F&& f) {
  const auto count =
      structural(m, 0, [](const auto& s, int) { return static_cast<int>(s.joint_springs.size()); });
  for_range(Index<0>(), count, f);
}

template <class M>
inline auto clearance_count(const M& m) {
  return structural(m, 0, [](const auto& s, int) { return static_cast<int>(s.clearances.size()); });
}
template <class M>
inline auto contact_count(const M& m) {
  return structural(m, 0, [](const auto& s, int) { return static_cast<int>(s.contacts.size()); });
}
template <class M>
inline auto friction_count(const M& m) {
  return structural(m, 0, [](const auto& s, int) { return static_cast<int>(s.frictions.size()); });
}
template <class M>
inline auto bristle_count(const M& m) {
  return structural(m, 0, [](const auto& s, int) { return s.nz; });
}

template <class M, class F>
inline void for_clearances(const M& m, F&& f) {
  for_range(Index<0>(), clearance_count(m), f);
}
// Contacts of one clearance.
template <class M, class C, class F>
inline void for_contacts(const M& m, C c, F&& f) {
  for_range(
      structural(m, c, [](const auto& s, int i) { return at(s.clearances, i).contact_begin; }),
      structural(m, c, [](const auto& s, int i) { return at(s.clearances, i).contact_end; }), f);
}
template <class M, class F>
inline void for_all_contacts(const M& m, F&& f) {
  for_range(Index<0>(), contact_count(m), f);
}
template <class M, class F>
inline void for_frictions(const M& m, F&& f) {
  for_range(Index<0>(), friction_count(m), f);
}

template <class M, class F>
inline void for_loads(const M& m, F&& f) {
  const auto count =
      structural(m, 0, [](const auto& s, int) { return static_cast<int>(s.loads.size()); });
  for_range(Index<0>(), count, f);
}

}  // namespace linkstudy
