#include "core/codegen/allocation.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace linkstudy::codegen {
namespace {

constexpr int kNever = std::numeric_limits<int>::max();

bool commutes(Op op) {
  return op == Op::add || op == Op::multiply || op == Op::bit_and || op == Op::bit_or ||
         op == Op::bit_xor || op == Op::equal;
}

class Allocator {
 public:
  Allocator(const Graph& graph, int slots, int registers, Order order)
      : nodes_(graph.nodes()),
        outputs_(graph.outputs()),
        place_(nodes_.size()),
        held_(static_cast<std::size_t>(registers), -1) {
    program_.slots = slots;
    for (Node& n : nodes_) {
      if (n.op == Op::negate) n = {Op::bit_xor, n.a, graph.sign()};
    }
    find_live();
    if (order == Order::depth_first) order_depth_first();
    list_uses();
    give_constants_slots();
  }

  Program run() {
    for (std::size_t i = 0; i < order_.size(); ++i) evaluate(static_cast<int>(i));
    // What is known without an operation.
    now_ = static_cast<int>(order_.size());
    for (const Output& o : outputs_) {
      if (operand_count(node(o.value).op) > 0) continue;
      pinned_.clear();
      store(in_register(o.value), o.slot);
      use(o.value);
    }
    return std::move(program_);
  }

 private:
  struct Place {
    int reg = -1;
    int slot = -1;
    bool owns_slot = false;  // one that others may have afterwards
    int first_use = 0;       // in uses_, then the next one
    int last_use = 0;        // one past
  };

  const Node& node(Value v) const { return nodes_[static_cast<std::size_t>(v)]; }
  Place& place(Value v) { return place_[static_cast<std::size_t>(v)]; }

  template <class F>
  void for_operands(const Node& n, F&& f) const {
    const int count = operand_count(n.op);
    if (count > 0) f(n.a);
    if (count > 1) f(n.b);
    if (count > 2) f(n.c);
  }

  void find_live() {
    std::vector<char> live(nodes_.size(), 0);
    for (const Output& o : outputs_) live[static_cast<std::size_t>(o.value)] = 1;
    for (std::size_t i = nodes_.size(); i-- > 0;) {
      if (live[i] == 0) continue;
      for_operands(nodes_[i], [&](Value v) { live[static_cast<std::size_t>(v)] = 1; });
    }
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (live[i] == 0) continue;
      if (operand_count(nodes_[i].op) > 0) {
        order_.push_back(static_cast<Value>(i));
      } else {
        known_.push_back(static_cast<Value>(i));
      }
    }
  }

  // Registers that a value needs if nothing else is kept, were it a tree (Sethi and Ullman 1970).
  std::vector<int> registers_needed() const {
    std::vector<int> needed(nodes_.size(), 0);
    for (const Value v : order_) {
      int most = 0, as_many = 0;
      for_operands(node(v), [&](Value x) {
        const int n = needed[static_cast<std::size_t>(x)];
        as_many = n > most ? 1 : n == most ? as_many + 1 : as_many;
        most = std::max(most, n);
      });
      needed[static_cast<std::size_t>(v)] = std::max(1, most + std::max(0, as_many - 1));
    }
    return needed;
  }

  // Outputs in the order in which they were made, each after what it still needs, the operand first
  // that needs most registers.
  void order_depth_first() {
    const std::vector<int> needed = registers_needed();
    std::vector<char> is_placed(nodes_.size(), 0);
    std::vector<Value> roots, order, open;
    for (const Output& o : outputs_) roots.push_back(o.value);
    std::ranges::sort(roots);
    const auto is_open = [&](Value v) {
      return is_placed[static_cast<std::size_t>(v)] == 0 && operand_count(node(v).op) > 0;
    };
    for (const Value root : roots) {
      if (is_open(root)) open.push_back(root);
      while (!open.empty()) {
        const Value v = open.back();
        Value next = -1;
        for_operands(node(v), [&](Value x) {
          if (is_open(x) && (next < 0 || needed[static_cast<std::size_t>(x)] >
                                             needed[static_cast<std::size_t>(next)])) {
            next = x;
          }
        });
        if (next >= 0) {
          open.push_back(next);
          continue;
        }
        open.pop_back();
        is_placed[static_cast<std::size_t>(v)] = 1;
        order.push_back(v);
      }
    }
    order_ = std::move(order);
  }

  // Positions of all uses, value by value.
  void list_uses() {
    const auto for_uses = [&](auto&& f) {
      for (std::size_t i = 0; i < order_.size(); ++i) {
        for_operands(node(order_[i]), [&](Value v) { f(v, static_cast<int>(i)); });
      }
      for (const Output& o : outputs_) {
        if (operand_count(node(o.value).op) == 0) f(o.value, static_cast<int>(order_.size()));
      }
    };
    for_uses([&](Value v, int) { ++place(v).last_use; });
    int total = 0;
    for (Place& p : place_) {
      p.first_use = total;
      total += p.last_use;
      p.last_use = p.first_use;
    }
    uses_.resize(static_cast<std::size_t>(total));
    for_uses([&](Value v, int i) { uses_[static_cast<std::size_t>(place(v).last_use++)] = i; });
  }

  void give_constants_slots() {
    for (const Value v : known_) {
      if (node(v).op == Op::input) {
        place(v).slot = static_cast<int>(node(v).bits);
      } else {
        place(v).slot = program_.slots++;
        program_.constants.push_back({place(v).slot, node(v).bits});
      }
    }
  }

  // After the present operation.
  int next_use(Value v) {
    const Place& p = place(v);
    int i = p.first_use;
    while (i < p.last_use && uses_[static_cast<std::size_t>(i)] <= now_) ++i;
    return i < p.last_use ? uses_[static_cast<std::size_t>(i)] : kNever;
  }

  // The present use is over.
  void use(Value v) {
    Place& p = place(v);
    while (p.first_use < p.last_use && uses_[static_cast<std::size_t>(p.first_use)] <= now_) {
      ++p.first_use;
    }
    if (p.first_use < p.last_use) return;
    if (p.reg >= 0) held_[static_cast<std::size_t>(p.reg)] = -1;
    p.reg = -1;
    if (p.owns_slot) left_slots_.push_back(p.slot);
    p.owns_slot = false;
  }

  void store(int reg, int slot) {
    Instruction s{Action::store};
    s.to = reg;
    s.first.slot = slot;
    program_.instructions.push_back(s);
  }

  void give_slot(Value v) {
    Place& p = place(v);
    if (p.slot >= 0) return;
    if (free_slots_.empty()) {
      p.slot = program_.slots++;
    } else {
      p.slot = free_slots_.back();
      free_slots_.pop_back();
    }
    p.owns_slot = true;
    store(p.reg, p.slot);
    ++program_.stores;
  }

  bool is_pinned(int reg) const {
    return std::find(pinned_.begin(), pinned_.end(), reg) != pinned_.end();
  }

  // The register whose value is used last, free ones first; -1: all are pinned.
  int farthest(int& use_there) {
    int best = -1;
    use_there = -1;
    for (int r = 0; r < static_cast<int>(held_.size()); ++r) {
      if (is_pinned(r)) continue;
      const Value v = held_[static_cast<std::size_t>(r)];
      if (v < 0) {
        use_there = kNever;
        return r;
      }
      const int next = next_use(v);
      if (next > use_there) {
        best = r;
        use_there = next;
      }
    }
    return best;
  }

  // One that holds nothing: what is used again has a slot afterwards.
  int vacate_register() {
    int use_there = 0;
    const int r = farthest(use_there);
    const Value before = held_[static_cast<std::size_t>(r)];
    if (before >= 0) {
      if (next_use(before) != kNever) give_slot(before);
      place(before).reg = -1;
    }
    held_[static_cast<std::size_t>(r)] = -1;
    return r;
  }

  int take_register(Value v) {
    const int r = vacate_register();
    hold(v, r);
    return r;
  }

  int in_register(Value v) {
    Place& p = place(v);
    if (p.reg < 0) {
      const int r = take_register(v);
      Instruction load{Action::load};
      load.to = r;
      load.first.slot = p.slot;
      program_.instructions.push_back(load);
    }
    pinned_.push_back(p.reg);
    return p.reg;
  }

  // Where it is, or in a register if it is used again before what that would drive out.
  Operand anywhere(Value v) {
    Place& p = place(v);
    if (p.reg < 0) {
      int use_there = 0;
      const int next = next_use(v);
      if (next == kNever || farthest(use_there) < 0 || use_there <= next) return {-1, p.slot};
    }
    return {in_register(v), -1};
  }

  bool is_here(Value v) { return place(v).reg >= 0; }
  bool ends_here(Value v) { return next_use(v) == kNever; }

  void evaluate(int i) {
    now_ = i;
    const Value v = order_[static_cast<std::size_t>(i)];
    const Node& n = node(v);
    free_slots_.insert(free_slots_.end(), left_slots_.begin(), left_slots_.end());
    left_slots_.clear();
    pinned_.clear();
    for_operands(n, [&](Value x) {
      if (is_here(x)) pinned_.push_back(place(x).reg);
    });
    Instruction made{Action::operate, n.op};
    if (is_fused(n.op)) {
      bring_fused(n, made);
      for_operands(n, [&](Value x) { use(x); });
      hold(v, made.to);
    } else {
      bring(n, made);
      for_operands(n, [&](Value x) { use(x); });
      pinned_.clear();
      made.to = take_register(v);
    }
    program_.instructions.push_back(made);
    for (const Output& o : outputs_of(v)) {
      store(made.to, o.slot);
      if (place(v).slot < 0) place(v).slot = o.slot;
    }
    if (ends_here(v)) use(v);
  }

  void hold(Value v, int reg) {
    held_[static_cast<std::size_t>(reg)] = v;
    place(v).reg = reg;
  }

  void bring(const Node& n, Instruction& made) {
    const int count = operand_count(n.op);
    if (n.op == Op::select) {
      made.first.reg = in_register(n.a);
      made.third.reg = in_register(n.c);
      made.second = anywhere(n.b);
    } else if (count == 1) {
      const bool reads_memory = n.op == Op::square_root;
      made.first = reads_memory ? anywhere(n.a) : Operand{in_register(n.a), -1};
    } else {
      const bool swap = commutes(n.op) && !is_here(n.a) && is_here(n.b);
      made.first.reg = in_register(swap ? n.b : n.a);
      made.second = anywhere(swap ? n.a : n.b);
    }
  }

  // Chooses what is overwritten: a value that ends here, else one that has to be loaded anyway,
  // else a copy.
  void bring_fused(const Node& n, Instruction& made) {
    const std::array<Value, 3> x = {n.a, n.b, n.c};
    int lost = -1;
    for (int k = 0; k < 3; ++k) {
      const Value v = x[static_cast<std::size_t>(k)];
      if (is_here(v) && ends_here(v)) lost = k;
    }
    for (int k = 0; k < 3 && lost < 0; ++k)
      if (!is_here(x[static_cast<std::size_t>(k)])) lost = k;
    if (lost < 0) lost = 2;
    Value y = lost == 0 ? n.b : n.a, z = lost == 2 ? n.b : n.c;
    const Value taken = x[static_cast<std::size_t>(lost)];
    if (!is_here(y) && is_here(z)) {
      std::swap(y, z);
      made.form = FusedForm::x_z_plus_y;
    }
    made.first.reg = in_register(y);
    made.second = anywhere(z);
    if (lost == 2) made.form = FusedForm::y_z_plus_x;
    made.to = overwritten(taken);
  }

  // A register with the value that may be overwritten.
  int overwritten(Value v) {
    Place& p = place(v);
    if (p.reg >= 0 && ends_here(v)) {
      const int r = p.reg;
      p.reg = -1;
      held_[static_cast<std::size_t>(r)] = -1;
      return r;
    }
    const int r = vacate_register();
    Instruction fetch{p.reg >= 0 ? Action::copy : Action::load};
    fetch.to = r;
    fetch.first = p.reg >= 0 ? Operand{p.reg, -1} : Operand{-1, p.slot};
    program_.instructions.push_back(fetch);
    return r;
  }

  std::vector<Output> outputs_of(Value v) {
    if (output_index_.empty()) {
      output_index_.assign(outputs_.begin(), outputs_.end());
      std::stable_sort(output_index_.begin(), output_index_.end(),
                       [](const Output& a, const Output& b) { return a.value < b.value; });
    }
    const auto less = [](const Output& a, const Output& b) { return a.value < b.value; };
    const auto [begin, end] =
        std::equal_range(output_index_.begin(), output_index_.end(), Output{v, 0}, less);
    return {begin, end};
  }

  std::vector<Node> nodes_;  // without signs to turn
  const std::vector<Output>& outputs_;
  std::vector<Output> output_index_;  // by value
  std::vector<Place> place_;
  std::vector<Value> order_, known_;  // operations; constants and inputs
  std::vector<int> uses_;
  std::vector<Value> held_;  // by register; -1: none
  std::vector<int> free_slots_;
  std::vector<int> left_slots_;  // read by the present operation for the last time
  std::vector<int> pinned_;      // registers that it reads
  int now_ = 0;
  Program program_;
};

}  // namespace

Program allocate(const Graph& graph, int slots, int registers, Order order) {
  return Allocator(graph, slots, registers, order).run();
}

}  // namespace linkstudy::codegen
