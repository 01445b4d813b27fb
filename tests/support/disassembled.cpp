#include "tests/support/disassembled.h"

#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace linkstudy::testing {
namespace disassembled {

using Instruction = Disassembled::Instruction;
using Operand = Disassembled::Operand;
using Kind = Operand::Kind;
using Bits = std::uint64_t;

constexpr int kMostLanes = 8;
using Lanes = std::array<Bits, kMostLanes>;

double number(Bits x) {
  return std::bit_cast<double>(x);
}
Bits bits(double x) {
  return std::bit_cast<Bits>(x);
}
Bits mask(bool x) {
  return x ? ~Bits{0} : 0;
}

std::string output_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
  if (!pipe) throw std::runtime_error("cannot run " + command);
  std::string text;
  std::array<char, 4096> buffer;
  for (std::size_t n = 0; (n = std::fread(buffer.data(), 1, buffer.size(), pipe.get())) > 0;) {
    text.append(buffer.data(), n);
  }
  return text;
}

std::string disassemble(const std::vector<std::uint8_t>& code) {
  const char* folder = std::getenv("TMPDIR");
  std::string name = std::string(folder ? folder : "/tmp") + "/code_XXXXXX";
  const int file = ::mkstemp(name.data());
  if (file < 0) throw std::runtime_error("no temporary file");
  ::close(file);
  std::ofstream(name, std::ios::binary)
      .write(reinterpret_cast<const char*>(code.data()), static_cast<std::streamsize>(code.size()));
  const std::string text = output_of(
      "objdump -D -b binary -m i386:x86-64 -M intel --no-show-raw-insn " + name + " 2>&1");
  std::remove(name.c_str());
  return text;
}

constexpr std::array<std::string_view, 9> kAddressRegisters = {"rdi", "rsi", "rdx", "rcx", "r8",
                                                               "r9",  "r10", "r11", "rax"};

std::size_t address_register(std::string_view name) {
  const auto found = std::ranges::find(kAddressRegisters, name);
  if (found == kAddressRegisters.end()) throw std::runtime_error("register " + std::string(name));
  return static_cast<std::size_t>(found - kAddressRegisters.begin());
}

// "[rdi]", "[rsi+0x40]", "ZMMWORD PTR [r8-0x40]"
Operand read_place(const std::string& text, int lanes) {
  const auto begin = text.find('[') + 1, end = text.find(']');
  if (begin == 0 || end == std::string::npos) throw std::runtime_error(text);
  const std::string inside = text.substr(begin, end - begin);
  const auto sign = inside.find_first_of("+-");
  Operand place{Kind::memory, 0, lanes, address_register(inside.substr(0, sign))};
  if (sign != std::string::npos) place.number = std::stoull(inside.substr(sign + 1), nullptr, 16);
  if (sign != std::string::npos && inside[sign] == '-') place.number = 0 - place.number;
  return place;
}

Operand read_operand(const std::string& text) {
  if (text.starts_with("ymm")) return {Kind::vector, std::stoull(text.substr(3)), 4};
  if (text.starts_with("zmm")) return {Kind::vector, std::stoull(text.substr(3)), 8};
  if (text.starts_with("k")) return {Kind::mask, std::stoull(text.substr(1))};
  if (text.starts_with("YMMWORD PTR")) return read_place(text, 4);
  if (text.starts_with("ZMMWORD PTR")) return read_place(text, 8);
  if (text.starts_with("[")) return read_place(text, 0);
  if (text.starts_with("r")) return {Kind::address, address_register(text)};
  if (text.starts_with("0x")) return {Kind::immediate, std::stoull(text, nullptr, 16)};
  throw std::runtime_error("operand " + text);
}

// "  1f:\tvaddpd zmm3,zmm4,ZMMWORD PTR [rdi+0x40]"
Instruction read_line(const std::string& line) {
  std::istringstream words(line.substr(line.find('\t') + 1));
  Instruction read;
  words >> read.mnemonic >> std::ws;
  for (std::string operand; std::getline(words, operand, ',');) {
    while (operand.ends_with(' ')) operand.pop_back();
    if (operand.empty()) continue;
    read.operands.push_back(read_operand(operand));
    read.lanes = std::max(read.lanes, read.operands.back().lanes);
  }
  return read;
}

// What a lane of the first operand becomes; x, y, z: this lane of the first three operands.
using Rule = std::function<Bits(Bits x, Bits y, Bits z)>;

// Digits of a fused operation are places: vfmadd231pd x, y, z is y z + x.
Rule fused_rule(const std::string& mnemonic, std::size_t digits) {
  const std::string kind = mnemonic.substr(0, digits);
  const double product = kind.starts_with("vfn") ? -1.0 : 1.0;
  const double term = kind.ends_with("sub") ? -1.0 : 1.0;
  const auto place = [&](std::size_t i) {
    return static_cast<std::size_t>(mnemonic[digits + i] - '1');
  };
  return [=, a = place(0), b = place(1), c = place(2)](Bits x, Bits y, Bits z) {
    const std::array<double, 3> all = {number(x), number(y), number(z)};
    return bits(std::fma(product * all[a], all[b], term * all[c]));
  };
}

template <class F>
Rule of_two(F f) {
  return [f](Bits, Bits y, Bits z) { return bits(f(number(y), number(z))); };
}
template <class F>
Rule of_bits(F f) {
  return [f](Bits, Bits y, Bits z) { return Bits{f(y, z)}; };
}

Bits upper_half_twice(Bits, Bits y, Bits order) {
  if (order != 0xf5) throw std::runtime_error("vpshufd in another order");
  return y >> 32 << 32 | y >> 32;
}

const std::map<std::string, Rule>& simple_rules() {
  static const std::map<std::string, Rule> rules = {
      {"vmovapd", [](Bits, Bits y, Bits) { return y; }},
      {"vsqrtpd", [](Bits, Bits y, Bits) { return bits(std::sqrt(number(y))); }},
      {"vaddpd", of_two([](double a, double b) { return a + b; })},
      {"vsubpd", of_two([](double a, double b) { return a - b; })},
      {"vmulpd", of_two([](double a, double b) { return a * b; })},
      {"vdivpd", of_two([](double a, double b) { return a / b; })},
      {"vminpd", of_two([](double a, double b) { return a < b ? a : b; })},
      {"vmaxpd", of_two([](double a, double b) { return a > b ? a : b; })},
      {"vandpd", of_bits([](Bits a, Bits b) { return a & b; })},
      {"vorpd", of_bits([](Bits a, Bits b) { return a | b; })},
      {"vxorpd", of_bits([](Bits a, Bits b) { return a ^ b; })},
      {"vpsllvq", of_bits([](Bits a, Bits count) { return count < 64 ? a << count : 0; })},
      {"vpsrlvq", of_bits([](Bits a, Bits count) { return count < 64 ? a >> count : 0; })},
      {"vpsraq", of_bits([](Bits a, Bits count) {
         return static_cast<Bits>(static_cast<std::int64_t>(a) >> std::min(count, Bits{63}));
       })},
      {"vpsrad", of_bits([](Bits a, Bits count) {
         const auto half = [count](Bits x) {
           const auto shifted = static_cast<std::int32_t>(x) >> std::min(count, Bits{31});
           return Bits{static_cast<std::uint32_t>(shifted)};
         };
         return half(a >> 32) << 32 | half(a);
       })},
      {"vpshufd", upper_half_twice},
      {"vcmpltpd", [](Bits, Bits y, Bits z) { return mask(number(y) < number(z)); }},
      {"vcmplepd", [](Bits, Bits y, Bits z) { return mask(number(y) <= number(z)); }},
      {"vcmpeqpd", [](Bits, Bits y, Bits z) { return mask(number(y) == number(z)); }},
      {"vpmovm2q", [](Bits, Bits y, Bits) { return y; }}};
  return rules;
}

Bits ternary_logic(Bits x, Bits y, Bits z, Bits table) {
  Bits result = 0;
  for (int i = 0; i < 64; ++i) {
    const Bits row = (x >> i & 1) << 2 | (y >> i & 1) << 1 | (z >> i & 1);
    result |= (table >> row & 1) << i;
  }
  return result;
}

// A rule that needs a fourth operand takes it from `last`.
Rule rule_of(const std::string& mnemonic, Bits last) {
  const auto simple = simple_rules().find(mnemonic);
  if (simple != simple_rules().end()) return simple->second;
  for (const char* order : {"132pd", "213pd", "231pd"}) {
    if (mnemonic.starts_with("vf") && mnemonic.ends_with(order)) {
      return fused_rule(mnemonic, mnemonic.size() - 5);
    }
  }
  if (mnemonic == "vpternlogq") {
    return [last](Bits x, Bits y, Bits z) { return ternary_logic(x, y, z, last); };
  }
  if (mnemonic == "vblendvpd") {
    return [last](Bits, Bits y, Bits z) { return last >> 63 != 0 ? z : y; };
  }
  throw std::runtime_error("unknown instruction " + mnemonic);
}

class Machine {
 public:
  explicit Machine(std::span<double> frame) : frame_(frame) {}

  void execute(const Instruction& i) {
    if (i.mnemonic == "vzeroupper" || i.mnemonic == "ret") return;
    if (i.mnemonic == "lea") {
      addresses_.at(i.operands.at(0).number) = address_of(i.operands.at(1));
      return;
    }
    if (i.lanes == 0) throw std::runtime_error("unknown instruction " + i.mnemonic);
    Lanes result{};  // a vector register is zero past what is written
    for (int k = 0; k < i.lanes; ++k) {
      const auto operand = [&](std::size_t n) {
        return n < i.operands.size() ? value(i.operands[n], k) : Bits{0};
      };
      const Rule rule = rule_of(i.mnemonic, operand(3));
      result[static_cast<std::size_t>(k)] = rule(operand(0), operand(1), operand(2));
    }
    write(i.operands.front(), result, i.lanes);
  }

 private:
  Bits address_of(const Operand& o) const { return addresses_.at(o.base) + o.number; }

  double& memory(const Operand& o, int k) {
    const Bits address = address_of(o);
    const std::size_t at = address / sizeof(double) + static_cast<std::size_t>(k);
    if (address % (static_cast<std::size_t>(o.lanes) * sizeof(double)) != 0 ||
        at >= frame_.size()) {
      throw std::runtime_error("unaligned or beyond the frame: " + std::to_string(address));
    }
    return frame_[at];
  }

  Bits value(const Operand& o, int k) {
    switch (o.kind) {
      case Kind::vector:
        return vectors_.at(o.number)[static_cast<std::size_t>(k)];
      case Kind::mask:
        return mask(masks_.at(o.number) >> k & 1);
      case Kind::memory:
        return bits(memory(o, k));
      case Kind::address:
      case Kind::immediate:
        return o.number;
    }
    return 0;
  }

  void write(const Operand& o, const Lanes& x, int lanes) {
    if (o.kind == Kind::vector) {
      vectors_.at(o.number) = x;
    } else if (o.kind == Kind::mask) {
      Bits& to = masks_.at(o.number) = 0;
      for (std::size_t k = 0; k < x.size(); ++k) to |= (x[k] & 1) << k;
    } else {
      for (int k = 0; k < lanes; ++k) memory(o, k) = number(x[static_cast<std::size_t>(k)]);
    }
  }

  std::span<double> frame_;
  std::array<Lanes, 32> vectors_{};
  std::array<Bits, 8> masks_{};
  std::array<Bits, kAddressRegisters.size()> addresses_{};  // from the start of the frame
};

}  // namespace disassembled

bool has_disassembler() {
  return std::system("objdump --version > /dev/null 2>&1") == 0;
}

std::vector<Disassembled> Disassembled::read(std::span<const std::vector<std::uint8_t>> functions) {
  std::vector<std::uint8_t> code;
  for (const auto& f : functions) code.insert(code.end(), f.begin(), f.end());
  std::istringstream lines(disassembled::disassemble(code));
  std::vector<Disassembled> all(1);
  for (std::string line; std::getline(lines, line);) {
    if (line.find(":\t") == std::string::npos) continue;
    all.back().instructions_.push_back(disassembled::read_line(line));
    if (all.back().instructions_.back().mnemonic == "ret") all.emplace_back();
  }
  if (!all.back().instructions_.empty()) throw std::runtime_error("code without an end");
  all.pop_back();
  return all;
}

void Disassembled::run(std::span<double> frame) const {
  disassembled::Machine machine(frame);
  for (const Instruction& i : instructions_) machine.execute(i);
}

}  // namespace linkstudy::testing
