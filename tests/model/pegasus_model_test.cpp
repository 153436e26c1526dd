/// Three-joint legs against MuJoCo on robots/pegasus/model.xml: joint axes, zeros, sides, and the whole
/// inverse dynamics.
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <array>
#include <memory>
#include <random>
#include <string>

#include "model/three_joint.h"
#include "tests/model/pegasus_leg.h"
#include "tests/support/paths.h"

namespace sprung {
namespace {

const std::string kPegasusModelLegs[] = {"fl", "fr", "hl", "hr"};

LegSide side_of(const std::string& leg) { return leg[1] == 'l' ? LegSide::kLeft : LegSide::kRight; }

/// The trunk stands still in the air; nothing but the bodies is left: no contact, friction, stops.
class PegasusModel : public testing::Test {
 protected:
  PegasusModel() : model_(load(), mj_deleteModel), data_(mj_makeData(model_.get()), mj_deleteData) {
    model_->opt.disableflags |= mjDSBL_CONSTRAINT | mjDSBL_PASSIVE;
    data_->qpos[2] = 5.0;
  }

  static mjModel* load() {
    std::array<char, 1000> error{};
    const std::string path = test::source_dir() + "/robots/pegasus/model.xml";
    mjModel* model = mj_loadXML(path.c_str(), nullptr, error.data(), static_cast<int>(error.size()));
    if (model == nullptr) throw std::runtime_error(error.data());
    return model;
  }
  int id(mjtObj type, const std::string& name) const { return mj_name2id(model_.get(), type, name.c_str()); }
  int joint(const std::string& leg, int j) const {
    static const char* const kNames[] = {"_abduction", "_hip", "_knee"};
    return id(mjOBJ_JOINT, leg + kNames[j]);
  }
  void without_inertia_about_rods() {
    for (const std::string& leg : kPegasusModelLegs) {
      for (const char* link : {"_thigh", "_shank"}) {
        const int body = id(mjOBJ_BODY, leg + link);
        int smallest = 0;
        for (int i = 1; i < 3; ++i) {
          if (model_->body_inertia[3 * body + i] < model_->body_inertia[3 * body + smallest]) smallest = i;
        }
        model_->body_inertia[3 * body + smallest] = 0.0;
      }
    }
  }
  void set(const std::string& leg, const JointVector& q, const JointVector& w, const JointVector& a) {
    for (int j = 0; j < 3; ++j) {
      const int at = joint(leg, j);
      data_->qpos[model_->jnt_qposadr[at]] = q[j];
      data_->qvel[model_->jnt_dofadr[at]] = w[j];
      data_->qacc[model_->jnt_dofadr[at]] = a[j];
    }
    mj_inverse(model_.get(), data_.get());
  }
  JointVector torque_Nm(const std::string& leg) const {
    JointVector torque(3);
    for (int j = 0; j < 3; ++j) torque[j] = data_->qfrc_inverse[model_->jnt_dofadr[joint(leg, j)]];
    return torque;
  }
  Eigen::Vector3d foot_in_hip_m(const std::string& leg) const {
    const mjtNum* foot = data_->geom_xpos + 3 * id(mjOBJ_GEOM, leg + "_foot");
    const mjtNum* hip = data_->xpos + 3 * id(mjOBJ_BODY, leg + "_hip_module");
    return Eigen::Vector3d(foot[0], foot[1], foot[2]) - Eigen::Vector3d(hip[0], hip[1], hip[2]);
  }
  JointVector random(double limit) {
    std::uniform_real_distribution<double> within(-limit, limit);
    JointVector v(3);
    for (int i = 0; i < 3; ++i) v[i] = within(random_);
    return v;
  }

  std::unique_ptr<mjModel, void (*)(mjModel*)> model_;
  std::unique_ptr<mjData, void (*)(mjData*)> data_;
  std::mt19937 random_{3};
};

TEST_F(PegasusModel, FeetAreWhereTheModelHasThem) {
  for (const std::string& leg : kPegasusModelLegs) {
    const ThreeJoint kinematics(test::pegasus_leg(side_of(leg)));
    for (int i = 0; i < 200; ++i) {
      const JointVector q = random(3.1), rest = JointVector::Zero(3);
      set(leg, q, rest, rest);
      ASSERT_LT((kinematics.foot_in_hip_m(q) - foot_in_hip_m(leg)).norm(), 1e-14)
          << leg << ' ' << q.transpose();
    }
  }
}

TEST_F(PegasusModel, InverseDynamicsIsTheModelsOnThinRods) {
  without_inertia_about_rods();
  for (const std::string& leg : kPegasusModelLegs) {
    const ThreeJoint kinematics(test::pegasus_leg(side_of(leg)));
    for (int i = 0; i < 200; ++i) {
      const JointVector q = random(3.1), w = random(8.0), a = random(200.0);
      set(leg, q, w, a);
      const JointVector torque = kinematics.inverse_dynamics_Nm(q, w, a);
      ASSERT_LT((torque - torque_Nm(leg)).norm(), 1e-10) << leg << ' ' << q.transpose();
    }
  }
}

/// What the thin rods leave out: the model's thigh and shank have 2.4e-4 kg m^2 about their own axes.
TEST_F(PegasusModel, InertiaAboutTheRodsOwnAxesIsWithin2_5Em4) {
  const ThreeJoint kinematics(test::pegasus_leg(LegSide::kLeft));
  double largest_Nm = 0.0;
  for (int i = 0; i < 200; ++i) {
    const JointVector q = random(3.1), rest = JointVector::Zero(3), a = random(100.0);
    set("fl", q, rest, a);
    largest_Nm = std::max(largest_Nm, (kinematics.inverse_dynamics_Nm(q, rest, a) - torque_Nm("fl")).norm());
  }
  EXPECT_LT(largest_Nm, 2.5e-4 * 100.0);
  EXPECT_GT(largest_Nm, 1e-3);
}

}  // namespace
}  // namespace sprung
