#include "tests/support/rsrrp_text.h"

#include <stdexcept>

namespace linkstudy::test {
namespace {

constexpr const char* kRsrrp = R"(format = 1
kind = "model"
name = "RSRRP linkage, reference set R1"
gravity = [0.0, -9.81, 0.0]

[[link]]
name = "crank"
mass = 1.0
center_of_mass = [0.0, "50 mm", 0.0]
inertia = [8.3333333e-4, 1.0e-4, 8.3333333e-4]

[[link]]
name = "slider"
mass = 2.0
inertia = [1.0e-3, 1.0e-3, 1.0e-3]

[[link]]
name = "yoke"
mass = 0.2
inertia = [1.0e-4, 1.0e-4, 1.0e-4]

[[link]]
name = "coupler"
mass = 1.5
center_of_mass = [0.0, 0.25, 0.0]
inertia = [0.03125, 1.0e-4, 0.03125]

[[joint]]
name = "A"
type = "revolute"
parent = "ground"
child = "crank"
frame = { position = [0, 0, 0], rotation = { axis = [0, 0, 1], angle = "0 deg" } }
initial = { position = ["0 deg"], velocity = [0.0] }

[[joint]]
name = "P"
type = "prismatic"
parent = "ground"
child = "slider"
frame = { position = [0, -0.3830127018922193, 0], matrix = [[0, -1, 0], [1, 0, 0], [0, 0, 1]] }
initial.position = ["25 cm"]

[[joint]]
name = "Q"
type = "revolute"
parent = "slider"
child = "yoke"
frame.position = [0.05, 0.0, 0.0]

[[joint]]
name = "R"
type = "revolute"
parent = "yoke"
child = "coupler"
frame.euler_zyx = [0.0, 0.0, "-90 deg"]
initial.position = ["-60 deg"]

[[closure]]
name = "S"
type = "spherical"
first  = { link = "crank",   position = [0.0, 0.1, 0.0] }
second = { link = "coupler", position = [0.0, 0.5, 0.0] }
model  = "cut"
cut.stabilization = "none"
sde = { axes = "ground", stiffness = 1.0e6, damping = 1.0e3 }

[[load]]
name = "drive"
type = "torque"
joint = "A"
course = { shape = "ramp", value = 10.0, duration = 5.0 }

[[load]]
name = "resistance"
type = "resistance"
joint = "A"
law = { shape = "linear", value = 10.0, at_speed = 9.0 }

[simulation]
end_time = 15.0
step = 1.0e-4
integrator = "rk4"
start = "equilibrium"
output_interval = 1.0e-2
)";

}  // namespace

std::string rsrrp_text() {
  return kRsrrp;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos || text.find(from, at + 1) != std::string::npos) {
    throw std::logic_error("test text: not exactly once: " + from);
  }
  return text.replace(at, from.size(), to);
}

}  // namespace linkstudy::test
