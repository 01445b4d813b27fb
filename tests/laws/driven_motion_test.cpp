// Kinematics and dynamics agree: where the drive has the acceleration that the equations of motion
// give it, all joints have theirs.
#include "core/kinematics/driven_motion.h"

#include <gtest/gtest.h>

#include "core/dynamics/motion.h"
#include "core/kinematics/drive_cycle.h"
#include "tests/mechanisms/bennett.h"
#include "tests/mechanisms/four_bar.h"
#include "tests/mechanisms/rsrrp.h"
#include "tests/mechanisms/spatial_slider_crank.h"
#include "tests/support/near.h"

namespace linkstudy::testing::driven_motion_test {
namespace {

constexpr double kSpeed = 7.0;  // rad/s, of the crank

Load torque_on_crank() {
  Load load;
  load.name = "drive";
  load.type = LoadType::drive;
  load.joint = "A";
  load.course.shape = CourseShape::constant;
  load.course.value = 3.0;
  return load;
}

Eigen::VectorXd one(double x) {
  return Eigen::VectorXd::Constant(1, x);
}

TEST(DrivenMotion, Has_the_accelerations_of_a_forced_run) {
  for (Linkage linkage : {four_bar(), bennett(), rsrrp(), rsrrp_revolute(), spatial_slider_crank(),
                          spatial_slider_crank_cut_at_universal()}) {
    SCOPED_TRACE(linkage.name);
    linkage.loads.push_back(torque_on_crank());
    const Model closed = compile_closed(linkage);
    State<double> start = closed.start;
    assemble_start(closed, start);
    const MobilityReport mobility = analyse_mobility(closed, start);
    const Drive drive = list_drives(closed.mechanism).front();
    const DrivenLinkage driven(closed, start, mobility, {drive});
    DriveCourse course;
    course.from = driven.drive_position(start)[0];
    course.to = *course.from + 3.0;
    const DrivePath path({course}, 3.0 / kSpeed);
    Workspace<double> w = make_workspace<double>(closed.mechanism);
    for (const DrivenPose& pose : follow_drives(driven, start, mobility, path, {16}).poses) {
      compute_motion(closed.mechanism, closed.parameters, pose.s, w);
      const auto qdd = Eigen::Map<const Eigen::VectorXd>(w.qdd.data(), closed.mechanism.nv);
      const double crank = qdd[drive.velocity.value()];
      EXPECT_GT(std::abs(crank), 1e-3);
      const DrivenRates rates = driven.rates(pose.s, one(kSpeed), one(crank));
      EXPECT_TRUE(near_relative(driven.scale().velocity.cwiseProduct(rates.second), qdd, 1e-9));
    }
  }
}

}  // namespace
}  // namespace linkstudy::testing::driven_motion_test
