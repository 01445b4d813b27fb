// Damaged models: see wrong_text.h.
#include <gtest/gtest.h>

#include "config_text.h"
#include "wrong_text.h"

namespace linkstudy::wrong_input_test {
namespace {

using test::expect_one_error;
using test::kRsrrp;
using test::Wrong;

class WrongModel : public ::testing::TestWithParam<Wrong> {};

TEST_P(WrongModel, Gives_one_error_at_the_marked_place) {
  expect_one_error(kRsrrp, GetParam());
}

// The same linkage with clearance, friction, a spring and a flexible coupler.
class WrongRealJoint : public ::testing::TestWithParam<Wrong> {};

TEST_P(WrongRealJoint, Gives_one_error_at_the_marked_place) {
  expect_one_error(test::real_joints_text(), GetParam());
}

const char* const kFrameR = "frame.euler_zyx = [0.0, 0.0, \"-90 deg\"]";
const char* const kSde = "sde = { axes = \"ground\", stiffness = 1.0e6, damping = 1.0e3 }";
const char* const kCourse = "course = { shape = \"ramp\", value = 10.0, duration = 5.0 }";
const char* const kLaw = "law = { shape = \"linear\", value = 10.0, at_speed = 9.0 }";
const char* const kGravity = "gravity = [0.0, -9.81, 0.0]";
const char* const kYoke = "name = \"yoke\"\nmass = 0.2";
const char* const kYokeInertia = "inertia = [1.0e-4, 1.0e-4, 1.0e-4]";
const char* const kStartA = "initial = { position = [\"0 deg\"], velocity = [0.0] }";
const char* const kJointQ = "parent = \"slider\"\nchild = \"yoke\"";

const Wrong kValues[] = {
    {"negative_mass", "mass = 1.5", "mass = @-1.5",
     "link 'coupler': mass must be positive, got -1.5 kg"},
    {"zero_step", "step = 1.0e-4", "step = @0.0", "simulation.step must be positive, got 0 s"},
    {"nan", "mass = 1.5", "mass = @nan", "link 'coupler': mass must be a finite number, got nan"},
    {"infinity", kGravity, "gravity = [0.0, @-inf, 0.0]",
     "gravity.1 must be a finite number, got -inf"},
    {"text_for_number", "mass = 1.5", "mass = @\"heavy\"",
     "mass must be a number in kg, got 'heavy'"},
    {"boolean_for_number", "mass = 1.5", "mass = @true", "mass must be a number in kg, got true"},
    {"number_for_text", "name = \"coupler\"", "name = @4",
     "link 3: name must be a name in quotes, got 4"},
    {"number_for_word", "start = \"equilibrium\"", "start = @1",
     "start must be a word in quotes, got 1"},
    {"number_for_boolean", kStartA, "initial = { hold = @1 }",
     "joint 'A': initial.hold must be true or false, got 1"},
    {"text_for_integer", "name = \"resistance\"\n", "name = \"resistance\"\ncoordinate = @\"0\"\n",
     "coordinate must be an integer, got '0'"},
    {"broken_integer", "name = \"resistance\"\n", "name = \"resistance\"\ncoordinate = @0.5\n",
     "coordinate must be an integer, got 0.5"},
    {"date", "name = \"RSRRP linkage, reference set R1\"", "name = @2016-01-01",
     "dates and times are not used"},
    {"wrong_unit", "mass = 1.5", "mass = @\"1.5 m\"", "mass must be a number in kg, got '1.5 m'"},
    {"angle_for_length", "frame.position = [0.05, 0.0, 0.0]", "frame.position = [@\"3 deg\", 0, 0]",
     "frame.position.0 must be a number in m, got '3 deg'"},
    {"unknown_unit", "mass = 1.5", "mass = @\"1.5 furlong\"", "'furlong' is not a unit"},
    {"no_unit", "mass = 1.5", "mass = @\"1.5\"", "without a unit", "remove the quotes"},
    {"per_second_is_no_turn", kLaw, "law = { value = 10.0, at_speed = @\"9 1/s\" }",
     "law.at_speed must be a number in rad/s or m/s, got '9 1/s'"},
    {"speed_of_a_turn", kLaw, "law = { value = 10.0, at_speed = @\"9 m/s\" }",
     "law.at_speed must be in rad/s here, got a value in m/s"},
    {"force_of_a_turn", kLaw, "law = { value = @\"10 N\", at_speed = 9.0 }",
     "law.value must be in N m here, got a value in N"},
    {"drive_in_newton", kCourse, "course = { value = @\"10 N\", duration = 5.0 }",
     "course.value must be in N m here, got a value in N"},
    {"slider_start_in_degrees", "initial.position = [\"25 cm\"]",
     "initial.position = [@\"25 deg\"]",
     "joint 'P': initial.position.0 must be in m here, got a value in rad"},
    {"crank_speed_in_metres", kStartA, "initial = { velocity = [@\"1 m/s\"] }",
     "initial.velocity.0 must be in rad/s here"},
    {"short_vector", kGravity, "gravity = @[0.0, -9.81]", "gravity must have 3 entries, got 2"},
    {"inertia_of_four", kYokeInertia, "inertia = @[1, 1, 1, 1]",
     "link 'yoke': inertia must have 3 or 6 entries, got 4"},
    {"scalar_for_vector", kGravity, "gravity = @-9.81",
     "gravity must be an array of numbers in m/s^2, got -9.81"},
    {"two_starts_for_one", "initial.position = [\"25 cm\"]", "initial.position = @[0.25, 0.1]",
     "initial.position must have 1 entry for this joint, got 2"},
    {"step_past_the_end", "end_time = 15.0\nstep = 1.0e-4", "end_time = 1e-3\nstep = @1.0e-2",
     "simulation.step must not exceed end_time = 0.001 s, got 0.01 s"},
    {"negative_damping", kSde, "sde = { stiffness = 1e6, damping = @-1.0 }",
     "sde.damping must not be negative, got -1 N s/m"},
    {"negative_component", kSde, "sde = { stiffness = { all = 1e6, x = @-1 } }",
     "closure 'S': sde.stiffness.x must not be negative, got -1 N/m"},
};

const Wrong kKeys[] = {
    {"unknown_key", kYoke, "name = \"yoke\"\nmass = 0.2\n@mas = 0.2",
     "link 'yoke': mas is not a known key", "did you mean 'mass'?"},
    {"far_key", kYoke, "name = \"yoke\"\nmass = 0.2\n@colour = 1", "colour is not a known key",
     "known: name, mass"},
    {"unknown_table", "[simulation]", "[@simulatoin]", "simulatoin is not a known key",
     "did you mean 'simulation'?"},
    {"unknown_deep_key", "cut.stabilization = \"none\"", "cut.@stabilisation = \"none\"",
     "closure 'S': cut.stabilisation is not a known key", "stabilization"},
    {"unknown_direction", kSde, "sde = { stiffness = { all = 1e6, @w = 1 } }",
     "sde.stiffness.w is not a known key"},
    {"missing_mass", "[[link]]\nname = \"yoke\"\nmass = 0.2", "@[[link]]\nname = \"yoke\"",
     "link 'yoke': mass is missing", "a number in kg"},
    {"missing_inertia", "[[link]]\nname = \"yoke\"\nmass = 0.2\ninertia = [1.0e-4, 1.0e-4, 1.0e-4]",
     "@[[link]]\nname = \"yoke\"\nmass = 0.2",
     "link 'yoke': inertia or inertia_at_origin is missing"},
    {"missing_type", "[[joint]]\nname = \"Q\"\ntype = \"revolute\"", "@[[joint]]\nname = \"Q\"",
     "joint 'Q': type is missing"},
    {"missing_name", "[[link]]\nname = \"yoke\"", "@[[link]]", "link 2: name is missing"},
    {"missing_format", "format = 1\nkind", "@kind", "format is missing"},
    {"missing_at_speed", kLaw, "law = @{ value = 10.0 }",
     "load 'resistance': law.at_speed is missing"},
    {"missing_course",
     "[[load]]\nname = \"drive\"\ntype = \"torque\"\njoint = \"A\"\ncourse = { shape = \"ramp\", "
     "value = 10.0, duration = 5.0 }",
     "@[[load]]\nname = \"drive\"\ntype = \"torque\"\njoint = \"A\"",
     "load 'drive': course is missing"},
    {"ground_axes_of_a_slide",
     "type = \"spherical\"\nfirst  = { link = \"crank\",   position = [0.0, 0.1, 0.0] }\n"
     "second = { link = \"coupler\", position = [0.0, 0.5, 0.0] }\n"
     "model  = \"cut\"\ncut.stabilization = \"none\"\nsde = { axes = \"ground\",",
     "type = \"cylindrical\"\nfirst  = { link = \"crank\",   position = [0.0, 0.1, 0.0] }\n"
     "second = { link = \"coupler\", position = [0.0, 0.5, 0.0] }\n"
     "model  = \"sde\"\nsde = { axes = @\"ground\",",
     "closure 'S': axes = \"ground\" stiffens directions of the ground", "axes = \"first\""},
    {"missing_stiffness", kSde, "sde = @{ axes = \"ground\" }",
     "closure 'S': sde.stiffness is missing"},
    {"missing_sde",
     "model  = \"cut\"\ncut.stabilization = \"none\"\nsde = { axes = \"ground\", stiffness = "
     "1.0e6, damping = 1.0e3 }",
     "model = @\"sde\"", "model = 'sde' needs the key sde.stiffness"},
    {"missing_duration", kCourse, "course = @{ value = 10.0 }", "course.duration is missing"},
    {"exclusive_damping", kSde, "sde = { stiffness = 1e6, damping = 1, @damping_ratio = 1 }",
     "sde.damping and damping_ratio exclude each other"},
    {"exclusive_rotations", kFrameR,
     "frame.euler_zyx = [0.0, 0.0, 0.0]\nframe.@quaternion = [1, 0, 0, 0]", "exclude each other"},
    {"pitch_of_a_hinge", "name = \"A\"\ntype = \"revolute\"",
     "name = \"A\"\ntype = \"revolute\"\n@pitch = 0.1",
     "joint 'A': pitch does not go with type = 'revolute'", "screw"},
    {"link_of_a_drive", "name = \"drive\"\n", "name = \"drive\"\n@link = \"crank\"\n",
     "load 'drive': link does not go with type = 'torque'"},
    {"single_table",
     "[[link]]\nname = \"crank\"\nmass = 1.0\ncenter_of_mass = [0.0, \"50 mm\", 0.0]\ninertia = "
     "[8.3333333e-4, 1.0e-4, 8.3333333e-4]\n\n[[link]]\nname = \"slider\"\nmass = 2.0\ninertia = "
     "[1.0e-3, 1.0e-3, 1.0e-3]\n\n[[link]]\nname = \"yoke\"\nmass = 0.2\ninertia = [1.0e-4, "
     "1.0e-4, 1.0e-4]\n\n[[link]]\nname = \"coupler\"\nmass = 1.5\ncenter_of_mass = [0.0, 0.25, "
     "0.0]\ninertia = [0.03125, 1.0e-4, 0.03125]",
     "@[link]\nname = \"crank\"\nmass = 1.0", "link must be an array of tables, got a table",
     "[[link]]"},
    {"table_for_value", "mass = 1.5", "mass = @{ kg = 1.5 }",
     "mass must be a number in kg, got a table"},
    {"value_for_table", "frame.position = [0.05, 0.0, 0.0]", "frame = @[0.05, 0.0, 0.0]",
     "joint 'Q': frame must be a table"},
};

const Wrong kWords[] = {
    {"unknown_word", "type = \"prismatic\"", "type = @\"prismtic\"",
     "joint 'P': type must be one of revolute", "did you mean 'prismatic'?"},
    {"spelled_otherwise", "start = \"equilibrium\"", "start = @\"Equilibrium\"",
     "start must be one of given, equilibrium", "did you mean 'equilibrium'?"},
    {"unknown_integrator", "integrator = \"rk4\"", "integrator = @\"rk45\"",
     "integrator must be one of rk4, adaptive, stiff", "did you mean 'rk4'?"},
    {"closure_of_a_screw", "type = \"spherical\"", "type = @\"screw\"",
     "closure 'S': type must be one of spherical, revolute"},
    {"other_format", "format = 1", "format = @2", "format must be 1, got 2"},
    {"other_kind", "kind = \"model\"", "kind = @\"modell\"", "there is no kind 'modell' of files",
     "did you mean 'model'?"},
    {"study_for_model", "kind = \"model\"", "kind = @\"study\"", "a model is expected here"},
};

const Wrong kRealJoints[] = {
    {"clearance_of_a_ball", "type = \"revolute\"\nfirst", "type = @\"spherical\"\nfirst",
     "closure 'S': model = \"clearance\" is for a closure of type revolute", "revolute"},
    {"clearance_without_its_table",
     "model = \"clearance\"\nclearance = { radial = 1e-3, bearing_radius = 5e-3 }",
     "model = @\"clearance\"",
     "model = 'clearance' needs the keys clearance.radial and clearance.bearing_radius",
     "radial = \"1 mm\""},
    {"no_radius", "{ radial = 1e-3, bearing_radius = 5e-3 }", "@{ radial = 1e-3 }",
     "closure 'S': clearance.bearing_radius is missing"},
    {"clearance_below_zero", "radial = 1e-3,", "radial = @\"-1 mm\",",
     "closure 'S': clearance.radial must be positive, got -0.001 m"},
    {"journal_of_no_radius", "bearing_radius = 5e-3", "bearing_radius = @1e-3",
     "clearance.bearing_radius must exceed clearance.radial = 0.001"},
    {"spatial_without_length", "clearance = { radial", "clearance = @{ kind = \"spatial\", radial",
     "clearance.length must be positive"},
    {"restitution_above_one", "restitution = 0.9", "restitution = @1.1",
     "closure 'S': contact.restitution must lie in (0, 1], got 1.1"},
    {"stiffness_with_a_unit", "restitution = 0.9", "stiffness = @\"1e9 N/m\"",
     "contact.stiffness must be a number, got '1e9 N/m'", "plain number"},
    {"exponent_without_stiffness", "restitution = 0.9", "exponent = @2.0",
     "contact.exponent must be 1.5 where K follows from the materials, got 2",
     "give contact.stiffness"},
    {"unknown_law", "restitution = 0.9", "law = @\"hertz\"",
     "contact.law must be one of lankarani_nikravesh, flores, hunt_crossley"},
    {"relaxing_without_damping", "restitution = 0.9", "free_bristle = @\"relax\"",
     "\"relax\" takes the time sigma1 / sigma0"},
    {"less_static_than_kinetic", "mu_s = 0.3", "mu_s = @0.1",
     "joint 'A': friction.mu_s must not be below friction.mu_k = 0.2, got 0.1"},
    {"friction_without_bristle", "{ mu_s = 0.3, mu_k = 0.2, sigma0 = 1e5, radius = 0.01 }",
     "@{ mu_s = 0.3, mu_k = 0.2, radius = 0.01 }", "joint 'A': friction.sigma0 is missing",
     "in 1/m"},
    {"no_stribeck_speed", "mu_s = 0.3", "mu_s = 0.3, stribeck_speed = @0.0",
     "joint 'A': friction.stribeck_speed must be positive, got 0 m/s"},
    {"friction_without_radius", "radius = 0.01", "radius = @0.0",
     "joint 'A': friction.radius must be positive, got 0"},
    {"friction_of_a_screw", "name = \"A\"\ntype = \"revolute\"\nfriction = ",
     "name = \"A\"\ntype = \"screw\"\npitch = 1.0\nfriction = @",
     "joint 'A': friction under the joint's own reaction is known for revolute",
     "use load = \"constant\" with a preload"},
    {"spring_of_a_turn_in_newton", "stiffness = [\"3 N m/rad\"]", "stiffness = [@\"3 N/m\"]",
     "joint 'A': spring.stiffness.0 must be in N m/rad here, got a value in N/m"},
    {"two_springs_for_one", "stiffness = [\"3 N m/rad\"]", "stiffness = @[1, 2]",
     "joint 'A': spring.stiffness must have 1 entry for this joint, got 2"},
    {"spring_that_pushes_away", "stiffness = [\"3 N m/rad\"]", "stiffness = [@-3]",
     "joint 'A': spring.stiffness.0 must not be negative, got -3"},
    {"half_a_segment", "segments = 4", "segments = @2.5",
     "flexible.segments must be an integer, got 2.5"},
    {"no_segment", "segments = 4", "segments = @0",
     "link 'coupler': flexible.segments must lie in [1, 200], got 0"},
    {"beam_without_end", "flexible = { segments = 4, end = [0, 0.5, 0], ",
     "flexible = @{ segments = 4, ", "link 'coupler': flexible.end is missing"},
    {"beam_of_no_length", "end = [0, 0.5, 0]", "end = @[0, 0, 0]",
     "flexible.begin and flexible.end are the same point"},
    {"beam_beside_the_centre", "center_of_mass = [0.0, 0.25, 0.0]",
     "center_of_mass = @[0.0, 0.2, 0.0]", "its center_of_mass in the middle [0, 0.25, 0]"},
    {"across_along", "segments = 4", "across = @[0, 1, 0]",
     "flexible.across must point across the beam"},
    {"no_across", "segments = 4", "across = @[0, 0, 0]",
     "link 'coupler': flexible.across must not be zero"},
    {"size_of_another_shape", "diameter = 0.02", "diameter = 0.02, @outer = 0.03",
     "flexible.section.outer does not go with shape = 'circle'", "tube"},
    {"tube_inside_out", "shape = \"circle\", diameter = 0.02",
     "shape = \"tube\", outer = 0.02, inner = @0.03",
     "flexible.section.inner must be below outer = 0.02 m, got 0.03 m"},
    {"negative_tolerance", "integrator = \"rk4\"", "tolerance.relative = @-1e-6",
     "simulation.tolerance.relative must be positive, got -1e-06"},
};

const Wrong kRotations[] = {
    {"reflection", kFrameR, "frame.matrix = @[[1, 0, 0], [0, 0, 1], [0, 1, 0]]",
     "must be a rotation, got a reflection", "sign of one axis"},
    {"skew_matrix", kFrameR, "frame.matrix = @[[1, 0.1, 0], [0, 1, 0], [0, 0, 1]]",
     "must be orthonormal to 1e-6, got an error of 0.1"},
    {"scaled_matrix", kFrameR, "frame.rotation = { matrix = @[[2, 0, 0], [0, 2, 0], [0, 0, 2]] }",
     "must be orthonormal"},
    {"matrix_of_two_rows", kFrameR, "frame.matrix = @[[1, 0, 0], [0, 1, 0]]",
     "frame.matrix must have 3 rows, got 2"},
    {"matrix_with_a_short_row", kFrameR, "frame.matrix = [[1, 0, 0], @[0, 1], [0, 0, 1]]",
     "frame.matrix.1 must have 3 entries, got 2"},
    {"long_quaternion", kFrameR, "frame.quaternion = @[1, 1, 0, 0]",
     "quaternion must have length 1"},
    {"zero_axis", kFrameR, "frame.rotation = { axis = @[0, 0, 0], angle = 1.0 }",
     "axis of rotation must not be zero"},
    {"axis_without_angle", kFrameR, "frame.rotation = @{ axis = [0, 0, 1] }",
     "an axis but no angle"},
    {"angle_without_axis", kFrameR, "frame.rotation = { euler_zyx = [0, 0, 0], angle = @1.0 }",
     "angle goes with axis only"},
    {"empty_rotation", kFrameR, "frame.rotation = @{}",
     "frame.rotation.axis or matrix or euler_zyx or quaternion is missing"},
    {"mirrored_closure", "first  = { link = \"crank\",   position = [0.0, 0.1, 0.0] }",
     "first = { link = \"crank\", matrix = @[[-1, 0, 0], [0, 1, 0], [0, 0, 1]] }",
     "closure 'S': first: matrix must be a rotation"},
    {"zero_direction", "[simulation]",
     "[[load]]\nname = \"push\"\ntype = \"link_force\"\nlink = \"crank\"\ndirection = @[0, 0, "
     "0]\ncourse = { shape = \"constant\", value = 1 }\n[simulation]",
     "load 'push': direction must not be zero"},
};

const Wrong kStructure[] = {
    {"unknown_parent", kJointQ, "parent = @\"slidr\"\nchild = \"yoke\"",
     "joint 'Q': parent is not a link, got 'slidr'", "did you mean 'slider'?"},
    {"unknown_child", kJointQ, "parent = \"slider\"\nchild = @\"yok\"",
     "joint 'Q': child is not a link, got 'yok'", "did you mean 'yoke'?"},
    {"ground_as_child", kJointQ, "parent = \"slider\"\nchild = @\"ground\"",
     "the child must be a moving link"},
    {"loop_in_the_tree", "[[joint]]\nname = \"Q\"\ntype = \"revolute\"\nparent = \"slider\"\n",
     "@[[joint]]\nname = \"Q\"\ntype = \"revolute\"\nparent = \"coupler\"\n",
     "joint 'Q': the links yoke - coupler - yoke form a loop that never reaches ground",
     "[[closure]]"},
    {"own_parent", kJointQ, "parent = \"yoke\"\nchild = @\"yoke\"",
     "parent and child are the same link 'yoke'"},
    {"link_carried_twice", "[[closure]]",
     "[[joint]]\nname = \"T\"\ntype = \"spherical\"\nparent = \"crank\"\nchild = "
     "@\"coupler\"\n[[closure]]",
     "link 'coupler' is already the child of joint 'R'", "[[closure]]"},
    {"disconnected_link", "[[joint]]\nname = \"A\"",
     "@[[link]]\nname = \"stray\"\nmass = 1\ninertia = [1, 1, 1]\n[[joint]]\nname = \"A\"",
     "link 'stray' is not connected"},
    {"duplicate_link", "[[joint]]\nname = \"A\"",
     "[[link]]\nname = @\"yoke\"\nmass = 1\ninertia = [1, 1, 1]\n[[joint]]\nname = \"A\"",
     "the name 'yoke' is used twice"},
    {"duplicate_load", "name = \"resistance\"", "name = @\"drive\"",
     "load: the name 'drive' is used twice"},
    {"reserved_name", "[[joint]]\nname = \"A\"",
     "[[link]]\nname = @\"ground\"\nmass = 1\ninertia = [1, 1, 1]\n[[joint]]\nname = \"A\"",
     "'ground' is reserved"},
    {"illegal_name", "name = \"resistance\"", "name = @\"re-sistance\"",
     "name must be a letter followed by letters, digits or _, got 're-sistance'"},
    {"closure_on_one_link", "second = { link = \"coupler\",", "second = { link = @\"crank\",",
     "both ends are on the same link 'crank'"},
    {"closure_on_no_link", "second = { link = \"coupler\",", "second = { link = @\"couplr\",",
     "second.link is not a link, got 'couplr'", "did you mean 'coupler'?"},
    {"load_on_no_joint", "type = \"torque\"\njoint = \"A\"", "type = \"torque\"\njoint = @\"B\"",
     "load 'drive': joint does not exist, got 'B'"},
    {"load_on_no_link", "[simulation]",
     "[[load]]\nname = \"push\"\ntype = \"link_torque\"\nlink = @\"ground\"\ndirection = [1, 0, "
     "0]\ncourse = { shape = \"constant\", value = 1 }\n[simulation]",
     "load 'push': link is not a moving link, got 'ground'"},
    {"point_on_no_link", "[simulation]",
     "[[point]]\nname = \"tip\"\nlink = @\"couplr\"\n[simulation]",
     "point 'tip': link is not a link, got 'couplr'", "did you mean 'coupler'?"},
    {"duplicate_point", "[simulation]",
     "[[point]]\nname = \"tip\"\nlink = \"yoke\"\n[[point]]\nname = @\"tip\"\nlink = "
     "\"crank\"\n[simulation]",
     "point: the name 'tip' is used twice"},
    {"point_without_link", "[simulation]", "@[[point]]\nname = \"tip\"\n[simulation]",
     "point 'tip': link is missing"},
    {"point_in_degrees", "[simulation]",
     "[[point]]\nname = \"tip\"\nlink = \"yoke\"\nposition = [0, @\"3 deg\", 0]\n[simulation]",
     "point 'tip': position.1 must be a number in m, got '3 deg'"},
    {"flat_point", "[simulation]",
     "[[point]]\nname = \"tip\"\nlink = \"yoke\"\nposition = @[0, 1]\n[simulation]",
     "point 'tip': position must have 3 entries, got 2"},
    {"no_such_coordinate", "type = \"torque\"\njoint = \"A\"",
     "type = \"torque\"\njoint = \"A\"\ncoordinate = @1",
     "joint 'A' has 1 coordinates, counted from 0, got 1"},
    {"torque_on_a_slider", "type = \"torque\"\njoint = \"A\"", "type = @\"torque\"\njoint = \"P\"",
     "type torque does not fit coordinate 0 of joint 'P', a translation", "\"force\""},
    {"impossible_inertia", kYokeInertia, "inertia = @[1.0, 1.0, 3.0]", "belongs to no body"},
    {"indefinite_inertia", kYokeInertia, "inertia = @[1, 1, 1, 5, 0, 0]",
     "must be positive definite"},
    {"indefinite_at_origin",
     "center_of_mass = [0.0, 0.25, 0.0]\ninertia = [0.03125, 1.0e-4, 0.03125]",
     "center_of_mass = [0.0, 0.25, 0.0]\ninertia_at_origin = @[0.03125, 1.0e-4, 0.03125]",
     "must be positive definite"},
    {"sde_without_stiffness",
     "model  = \"cut\"\ncut.stabilization = \"none\"\nsde = { axes = \"ground\", stiffness = "
     "1.0e6, damping = 1.0e3 }",
     "model = \"sde\"\nsde = { stiffness = @{ x = 0 } }",
     "no direction of the spring-damping element is stiff"},
    {"table_not_rising", kCourse,
     "course = { shape = \"table\", times = [0, 1, @1], values = [0, 1, 2] }",
     "course.times must increase, got 1 after 1"},
    {"table_of_other_length", kCourse,
     "course = { shape = \"table\", times = [0, 1], values = @[0, 1, 2] }",
     "must have the same length, got 2 and 3"},
    {"name_with_a_digit_first", "[[closure]]\nname = \"S\"", "[[closure]]\nname = @\"9S\"",
     "closure '9S': name must"},
};

// Each in the place of kYokeInertia.
const Wrong kShapes[] = {
    {"one_table_for_solids", kYokeInertia, "inertia = [1, 1, 1]\nshape = @{ kind = \"sphere\" }",
     "link 'yoke': shape must be an array of tables, got a table",
     "write [[link.shape]] before each"},
    {"unknown_solid", kYokeInertia, "inertia = [1, 1, 1]\nshape = [{ kind = @\"sphera\" }]",
     "link 'yoke': shape 0: kind must be one of cylinder, box, sphere, got 'sphera'",
     "did you mean 'sphere'?"},
    {"solid_without_kind", kYokeInertia, "inertia = [1, 1, 1]\nshape = [@{ diameter = 0.01 }]",
     "link 'yoke': shape 0: kind is missing", "a word in quotes"},
    {"negative_diameter", kYokeInertia,
     "inertia = [1, 1, 1]\nshape = [{ kind = \"sphere\", diameter = @\"-2 mm\" }]",
     "link 'yoke': shape 0: diameter must be positive, got -0.002 m"},
    {"negative_side", kYokeInertia,
     "inertia = [1, 1, 1]\nshape = [{ kind = \"box\", sides = [1, @-1, 1] }]",
     "link 'yoke': shape 0: sides.1 must be positive, got -1 m"},
    {"sphere_that_turns", kYokeInertia,
     "inertia = [1, 1, 1]\nshape = [{ kind = \"sphere\", diameter = 1, @euler_zyx = [1, 0, 0] }]",
     "link 'yoke': shape 0: euler_zyx does not go with kind = 'sphere'", "it goes with kind = box"},
    {"box_between_points", kYokeInertia,
     "inertia = [1, 1, 1]\nshape = [{ kind = \"box\", sides = [1, 1, 1], @end = [1, 0, 0] }]",
     "link 'yoke': shape 0: end does not go with kind = 'box'", "it goes with kind = cylinder"},
    {"mirrored_box", kYokeInertia,
     "inertia = [1, 1, 1]\nshape = [{ kind = \"box\", sides = [1, 1, 1], matrix = @[[-1, 0, 0], "
     "[0, 1, 0], [0, 0, 1]] }]",
     "link 'yoke': shape 0: matrix must be a rotation, got a reflection", "sign of one axis"},
    {"cylinder_of_no_length", kYokeInertia,
     "inertia = [1, 1, 1]\nshape = [{ kind = \"cylinder\", end = @[0, 0, 0], diameter = 1 }]",
     "link 'yoke': shape 0: begin and end are the same point", "two faces"},
    {"second_solid_without_size", kYokeInertia,
     "inertia = [1, 1, 1]\nshape = [{ kind = \"sphere\", diameter = 1 }, @{ kind = \"box\" }]",
     "link 'yoke': shape 1: sides is missing", "an array of numbers in m"},
};

const Wrong kSyntax[] = {
    {"open_text", "name = \"resistance\"", "name = \"resistance@", "not TOML"},
    {"repeated_key", "mass = 1.5", "mass = 1.5\nmass = @2.5", "not TOML"},
    {"no_value", "mass = 1.5", "mass = @\nx = 1", "not TOML"},
    {"huge_integer", "mass = 1.5", "mass = 99999999999999999999@", "not TOML"},
    {"control_character", "mass = 1.5", "mass = 1.5@\x01", "not TOML"},
    {"header_begins_with_a_dot", "[simulation]", "[@.a]", "not TOML"},
    {"header_without_name", "[simulation]", "[@=]", "not TOML"},
    {"header_with_comment", "[simulation]", "[@#]", "not TOML"},
    {"list_header_begins_with_a_dot", "[simulation]", "[[@.x]]", "not TOML"},
    {"letter_in_a_key", "mass = 1.5", "m@\u00e4ss = 1.5", "not TOML"},
    {"letter_behind_a_value", "mass = 1.5", "mass = 1.5@\u00e9", "not TOML"},
    {"letter_for_a_value", "mass = 1.5", "mass = @\u00e9", "not TOML"},
    {"letter_as_an_escape", "RSRRP linkage", "RSRRP \\@\u00e9linkage", "not TOML"},
    {"latin_1", "RSRRP linkage", "RSRRP @\xE9linkage", "not UTF-8 text, got byte 0xE9"},
    {"overlong_utf8", "RSRRP linkage", "RSRRP @\xC0\x80linkage", "not UTF-8"},
};

std::string name_of_case(const ::testing::TestParamInfo<Wrong>& info) {
  return info.param.what;
}

INSTANTIATE_TEST_SUITE_P(Values, WrongModel, ::testing::ValuesIn(kValues), name_of_case);
INSTANTIATE_TEST_SUITE_P(Keys, WrongModel, ::testing::ValuesIn(kKeys), name_of_case);
INSTANTIATE_TEST_SUITE_P(Words, WrongModel, ::testing::ValuesIn(kWords), name_of_case);
INSTANTIATE_TEST_SUITE_P(Wrong, WrongRealJoint, ::testing::ValuesIn(kRealJoints), name_of_case);
INSTANTIATE_TEST_SUITE_P(Rotations, WrongModel, ::testing::ValuesIn(kRotations), name_of_case);
INSTANTIATE_TEST_SUITE_P(Structure, WrongModel, ::testing::ValuesIn(kStructure), name_of_case);
INSTANTIATE_TEST_SUITE_P(Shapes, WrongModel, ::testing::ValuesIn(kShapes), name_of_case);
INSTANTIATE_TEST_SUITE_P(Syntax, WrongModel, ::testing::ValuesIn(kSyntax), name_of_case);

}  // namespace
}  // namespace linkstudy::wrong_input_test
