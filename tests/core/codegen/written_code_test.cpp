// What is written from a graph computes what the graph says, and the graph what C++ says: to the
// bit, for all numbers there are.
#include "core/codegen/written_code.h"

#include <gtest/gtest.h>
#include <sys/mman.h>

#include <bit>
#include <cmath>
#include <random>

#include "core/base/elementary.h"
#include "core/base/isa.h"
#include "core/codegen/traced.h"
#include "tests/core/codegen/drawn_graphs.h"

namespace linkstudy::testing::written_code_test {
namespace {

using codegen::Graph;
using codegen::Op;
using codegen::Program;
using codegen::Value;
using codegen::WrittenCode;

// The code that this machine can run, on slots of four numbers and of eight, and on two frames.
std::vector<Target> targets() {
  std::vector<Target> all;
  for (const Target& t :
       {Target{InstructionSet::avx2, 4}, Target{InstructionSet::avx2, 8},
        Target{InstructionSet::avx512, 8}, Target{InstructionSet::avx512, 8, 2}}) {
    if (machine_has(t.isa)) all.push_back(t);
  }
  return all;
}

class WrittenCodeTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (targets().empty()) GTEST_SKIP() << "no AVX2 here";
  }

  // Runs code and interpreter on random inputs and compares all slots.
  static void expect_equal_runs(const Graph& graph, int inputs, int slots,
                                std::mt19937_64& random) {
    for (const Target& target : targets()) {
      SCOPED_TRACE(target.name());
      const Program program = target.allocate(graph, slots);
      const auto code = WrittenCode::place(target.assemble(program));
      ASSERT_NE(code, nullptr);
      DrawnFrames frames(graph, program, inputs, slots, target, random);
      for (int k = 0; k < target.slot_numbers; k += native_lanes(target.isa)) {
        code->function()(frames.numbers().data() + k);
      }
      ASSERT_TRUE(frames.are_as_expected());
    }
  }
};

TEST_F(WrittenCodeTest, Computes_what_random_graphs_say) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    DrawnGraph drawn(seed);
    expect_equal_runs(drawn.graph, drawn.inputs, drawn.slots, drawn.random);
    if (HasFatalFailure()) return;
  }
}

// A hundred values that all wait for the last one, then are used in turn.
TEST_F(WrittenCodeTest, Keeps_more_values_alive_than_there_are_registers) {
  constexpr int kMany = 100;
  Graph graph;
  std::vector<Value> alive;
  Value last = graph.input(0);
  for (int i = 1; i < kMany; ++i) {
    last = graph.make(Op::madd, graph.input(i), graph.input(i - 1), last);
    alive.push_back(last);
  }
  Value sum = last;
  for (const Value v : alive) sum = graph.make(Op::nmadd, v, sum, v);
  graph.write(sum, kMany);
  std::mt19937_64 random(7);
  expect_equal_runs(graph, kMany, kMany + 1, random);
  for (const int registers : {16, 32}) {
    const Program program = codegen::allocate(graph, kMany + 1, registers);
    EXPECT_GE(program.stores, kMany - registers - 1);
    EXPECT_LE(program.stores, kMany);  // each once
  }
}

TEST_F(WrittenCodeTest, Leaves_its_inputs_and_writes_what_is_known_already) {
  Graph graph;
  graph.write(graph.input(0), 1);
  graph.write(graph.constant(2.5), 2);
  graph.write(graph.make(Op::add, graph.input(0), graph.constant(-0.0)), 3);
  std::mt19937_64 random(3);
  expect_equal_runs(graph, 1, 4, random);
}

// Five places where times differ, two where they do not; what is kept is one of them.
TEST_F(WrittenCodeTest, Is_placed_where_it_runs_and_computes_the_same) {
  DrawnGraph drawn(17);
  const Target target{InstructionSet::avx2, 4};
  const Program program = target.allocate(drawn.graph, drawn.slots);
  const auto code = WrittenCode::place_well(target.assemble(program), program.slots * 4);
  ASSERT_NE(code, nullptr);
  DrawnFrames frames(drawn.graph, program, drawn.inputs, drawn.slots, target, drawn.random);
  code->function()(frames.numbers().data());
  EXPECT_TRUE(frames.are_as_expected());
}

TEST(Memory, That_may_not_be_executed_gives_no_code) {
  const std::vector<std::uint8_t> code = {0xc3};
  int asked = -1;
  static int* rights_asked;
  rights_asked = &asked;
  EXPECT_EQ(WrittenCode::place(code,
                               [](void*, std::size_t, int rights) {
                                 *rights_asked = rights;
                                 return -1;
                               }),
            nullptr);
  EXPECT_EQ(asked, PROT_READ | PROT_EXEC);  // never writable and executable
  EXPECT_EQ(WrittenCode::place({}), nullptr);
}

namespace {

// Arithmetic written once for every scalar: the step loop's own functions.
template <class Real>
std::vector<Real> arithmetic(const Real& a, const Real& b, const Real& c) {
  const SinCos<Real> t = sincos(a);
  const Real chosen = select(a < b && !(c == a), min(a, b), max(b, c));
  return {t.sin,
          t.cos,
          exp(b),
          log(abs(c)),
          power(abs(a), b),
          quadrant_angle(abs(a) + Real(1.0), abs(b)),
          chosen,
          msub(a, b, c) - nmadd(a, c, b),
          -(a - b) * Real(0.5) + sqrt(abs(a)) / Real(4.0),
          select(is_finite(a * c) || a >= c, Real(1.0) / c, -c)};
}

struct Fused {  // double with the rounding of the fused instruction sets
  double x = 0.0;
  Fused() = default;
  explicit Fused(double number) : x(number) {}
};
#define LINKSTUDY_FUSED_OPERATION(symbol)   \
  Fused operator symbol(Fused a, Fused b) { \
    return Fused(a.x symbol b.x);           \
  }
LINKSTUDY_FUSED_OPERATION(+)
LINKSTUDY_FUSED_OPERATION(-)
LINKSTUDY_FUSED_OPERATION(*)
LINKSTUDY_FUSED_OPERATION(/)
#undef LINKSTUDY_FUSED_OPERATION
Fused operator-(Fused a) {
  return Fused(-a.x);
}
bool operator<(Fused a, Fused b) {
  return a.x < b.x;
}
bool operator>(Fused a, Fused b) {
  return a.x > b.x;
}
bool operator<=(Fused a, Fused b) {
  return a.x <= b.x;
}
bool operator>=(Fused a, Fused b) {
  return a.x >= b.x;
}
bool operator==(Fused a, Fused b) {
  return a.x == b.x;
}
Fused madd(Fused a, Fused b, Fused c) {
  return Fused(std::fma(a.x, b.x, c.x));
}
Fused msub(Fused a, Fused b, Fused c) {
  return Fused(std::fma(a.x, b.x, -c.x));
}
Fused nmadd(Fused a, Fused b, Fused c) {
  return Fused(std::fma(-a.x, b.x, c.x));
}
Fused select(bool mask, Fused a, Fused b) {
  return mask ? a : b;
}
Fused sqrt(Fused a) {
  return Fused(std::sqrt(a.x));
}
Fused abs(Fused a) {
  return Fused(std::fabs(a.x));
}
Fused min(Fused a, Fused b) {
  return a.x < b.x ? a : b;
}
Fused max(Fused a, Fused b) {
  return a.x > b.x ? a : b;
}
bool is_finite(Fused a) {
  return std::isfinite(a.x);
}
Fused power_of_two(Fused n) {
  return Fused(linkstudy::power_of_two(n.x));
}
template <int k>
Fused sign_from_bit(Fused sum) {
  return Fused(linkstudy::sign_from_bit<k>(sum.x));
}
Fused turned(Fused a, Fused sign) {
  return Fused(linkstudy::turned(a.x, sign.x));
}
bool has_sign(Fused a) {
  return linkstudy::has_sign(a.x);
}
Fused binary_exponent(Fused a) {
  return Fused(linkstudy::binary_exponent(a.x));
}
Fused binary_fraction(Fused a) {
  return Fused(linkstudy::binary_fraction(a.x));
}

}  // namespace

TEST(Traced, Functions_of_the_step_loop_leave_their_own_meaning) {
  Graph graph;
  const codegen::Trace trace(graph);
  const std::vector<Traced> traced = arithmetic(
      Traced::from(graph.input(0)), Traced::from(graph.input(1)), Traced::from(graph.input(2)));
  for (std::size_t i = 0; i < traced.size(); ++i) {
    graph.write(traced[i].value, 3 + static_cast<int>(i));
  }
  std::mt19937_64 random(5);
  for (int run = 0; run < 2000; ++run) {
    std::vector<double> slots(3 + traced.size());
    // powers of two are of whole numbers in their range only, as the scalar says
    std::uniform_real_distribution<double> uniform(-30.0, 30.0);
    for (int i = 0; i < 3; ++i) {
      slots[static_cast<std::size_t>(i)] = run % 4 == 0 ? draw_number(random) : uniform(random);
    }
    const auto expected = arithmetic(Fused(slots[0]), Fused(slots[1]), Fused(slots[2]));
    interpret(graph, slots);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const double x = slots[3 + i], y = expected[i].x;
      EXPECT_TRUE(same_number(x, y) || (x == 0.0 && y == 0.0)) << i << ": " << x << " for " << y;
    }
  }
}

TEST(Traced, What_is_known_costs_nothing) {
  Graph graph;
  const codegen::Trace trace(graph);
  const Traced x = Traced::from(graph.input(0)), y = Traced::from(graph.input(1));
  const Traced one(1.0), none(0.0);
  EXPECT_EQ((x * one).value, x.value);
  EXPECT_EQ(madd(x, none, y).value, y.value);
  EXPECT_EQ(madd(x, y, none).value, (y * x).value);
  EXPECT_EQ(madd(-one, x, y).value, (y - x).value);
  EXPECT_EQ((x + -y).value, (x - y).value);
  EXPECT_EQ(madd(-x, y, none - none).value, (-(x * y)).value);
  EXPECT_EQ(nmadd(-x, y, -x).value, msub(y, x, x).value);
  EXPECT_EQ((x / Traced(4.0)).value, (x * Traced(0.25)).value);
  EXPECT_NE((x / Traced(3.0)).value, (x * Traced(1.0 / 3.0)).value);
  EXPECT_NE((-(x - y)).value, (y - x).value);  // not of zeros
  EXPECT_NE((none - x).value, (-x).value);
  EXPECT_EQ(select(!(x < y), x, y).value, select(x < y, y, x).value);
  EXPECT_TRUE(all(one > none));
  EXPECT_FALSE(any(one < none));
  EXPECT_TRUE(any(x < y));
  EXPECT_FALSE(all(x < y));
  const double third = 1.0 / 3.0;
  EXPECT_NE(madd(Traced(third), Traced(third), x).value, (x + Traced(third * third)).value);
}

TEST(Traced, Questions_about_lanes_become_requirements_and_numbers_of_lanes_are_refused) {
  Graph graph;
  const codegen::Trace trace(graph);
  const Traced x = Traced::from(graph.input(0));
  EXPECT_EQ(lane_bits(x < Traced(2.0)), 1u);
  graph.write(graph.required(), 1);
  std::vector<double> slots = {3.0, 1.0};
  interpret(graph, slots);
  EXPECT_EQ(std::bit_cast<std::uint64_t>(slots[1]), 0u);
  slots[0] = 1.0;
  interpret(graph, slots);
  EXPECT_EQ(std::bit_cast<std::uint64_t>(slots[1]), Graph::kTrue);
  Traced y = x;
  EXPECT_THROW(lane(x, 0), Untraceable);
  EXPECT_THROW(set_lane(y, 0, 1.0), Untraceable);
}

}  // namespace
}  // namespace linkstudy::testing::written_code_test
