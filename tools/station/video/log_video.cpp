#include "tools/station/video/log_video.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "robots/robot_loader.h"
#include "simulation/plant/plant_model.h"
#include "tools/logs/log/robot_names.h"
#include "tools/logs/log/timeline.h"
#include "tools/station/frames/frames.h"
#include "tools/station/frames/version_notes.h"
#include "tools/station/video/offscreen_gl.h"
#include "tools/station/video/video_pipe.h"

namespace sprung::station {

namespace {

constexpr double kForceScale_m_N = 0.0012;  // as in page/robot_view.js
constexpr float kForceColour[4] = {0.835F, 0.369F, 0.0F, 1.0F};

/// MuJoCo's model in the poses of frames.
class PosedModel {
 public:
  PosedModel(const RobotConfig& robot, const std::string& model_xml, const std::vector<FrameField>& fields)
      : model_(sim::load_model_xml(model_xml)), data_(mj_makeData(model_.get())) {
    base_ = find(mjOBJ_BODY, "base");
    trunk_ = find_field(fields, "trunk.x_m");
    for (const JointConfig& joint : robot.joints) {
      joints_.push_back({model_->jnt_qposadr[find(mjOBJ_JOINT, joint.name)],
                         find_field(fields, "joints." + joint.name + ".estimated_position_rad")});
    }
    for (const LegConfig& leg : robot.legs) {
      const int foot = mj_name2id(model_.get(), mjOBJ_GEOM, (leg.name + "_foot").c_str());
      const std::string prefix = "legs." + leg.name + ".";
      if (foot >= 0)
        feet_.push_back(
            {foot, find_field(fields, prefix + "foot_force_N.x"), find_field(fields, prefix + "contact")});
    }
  }

  void pose(const Frame& frame) {
    for (const Joint& joint : joints_) {
      const double angle_rad = value(frame, joint.field);
      if (std::isfinite(angle_rad)) data_->qpos[joint.qpos] = angle_rad;
    }
    place_base(frame);
    mj_kinematics(model_.get(), data_.get());
    mj_comPos(model_.get(), data_.get());
    mj_camlight(model_.get(), data_.get());
  }
  /// Estimated, at feet in contact, into a scene that is drawn anyway.
  void add_forces(const Frame& frame, mjvScene& scene) const {
    for (const Foot& foot : feet_) {
      if (!(value(frame, foot.contact) > 0.5) || scene.ngeom >= scene.maxgeom) continue;
      mjtNum force_N[3], in_world_N[3];
      for (int i = 0; i < 3; ++i) force_N[i] = value(frame, foot.force + i);
      if (!std::isfinite(force_N[0] + force_N[1] + force_N[2])) continue;
      mju_rotVecMat(in_world_N, force_N, data_->xmat + 9 * base_);
      const mjtNum* const from = data_->geom_xpos + 3 * foot.geom;
      mjvGeom& arrow = scene.geoms[scene.ngeom++];
      mjv_initGeom(&arrow, mjGEOM_ARROW, nullptr, nullptr, nullptr, kForceColour);
      mjv_makeConnector(&arrow, mjGEOM_ARROW, 0.012, from[0], from[1], from[2],
                        from[0] + kForceScale_m_N * in_world_N[0], from[1] + kForceScale_m_N * in_world_N[1],
                        from[2] + kForceScale_m_N * in_world_N[2]);
    }
  }
  mjvCamera camera() const {
    mjvCamera camera;
    mjv_defaultCamera(&camera);
    camera.fixedcamid = mj_name2id(model_.get(), mjOBJ_CAMERA, "follow");
    camera.type = camera.fixedcamid >= 0 ? mjCAMERA_FIXED : mjCAMERA_TRACKING;
    camera.trackbodyid = base_;
    return camera;
  }
  mjModel& model() noexcept { return *model_; }
  mjData& data() noexcept { return *data_; }

 private:
  struct Joint {
    int qpos = 0, field = -1;
  };
  struct Foot {
    int geom = 0, force = -1, contact = -1;
  };

  int find(mjtObj type, const std::string& name) const {
    const int id = mj_name2id(model_.get(), type, name.c_str());
    if (id < 0)
      throw std::runtime_error("model.xml has no " + std::string(mju_type2Str(type)) + " named " + name);
    return id;
  }
  static double value(const Frame& frame, int field) {
    return field < 0 ? NAN : static_cast<double>(frame.values[static_cast<std::size_t>(field)]);
  }
  /// On a free joint as it is; on slides as far as these go; else it is fixed.
  void place_base(const Frame& frame) {
    if (!std::isfinite(value(frame, trunk_))) return;
    for (int i = 0; i < model_->body_jntnum[base_]; ++i) {
      const int joint = model_->body_jntadr[base_] + i;
      mjtNum* const qpos = data_->qpos + model_->jnt_qposadr[joint];
      if (model_->jnt_type[joint] == mjJNT_FREE) {
        constexpr int kPoseNumbers = 7;
        for (int k = 0; k < kPoseNumbers; ++k) qpos[k] = value(frame, trunk_ + k);
      } else if (model_->jnt_type[joint] == mjJNT_SLIDE) {
        mjtNum moved[3];
        for (int k = 0; k < 3; ++k) moved[k] = value(frame, trunk_ + k) - model_->body_pos[3 * base_ + k];
        *qpos = mju_dot3(moved, model_->jnt_axis + 3 * joint);
      }
    }
  }

  sim::ModelPtr model_;
  sim::DataPtr data_;
  int base_ = 0, trunk_ = -1;
  std::vector<Joint> joints_;
  std::vector<Foot> feet_;
};

/// MuJoCo's renderer. An OpenGL context must be current from before it is made until it is gone.
class Renderer {
 public:
  Renderer(mjModel& model, int width, int height) : model_(model), size_{0, 0, width, height} {
    model.vis.global.offwidth = width;
    model.vis.global.offheight = height;
    constexpr int kShadows = 1024;  // of the model's 4096: by software a quarter of the time
    model.vis.quality.shadowsize = std::min(model.vis.quality.shadowsize, kShadows);
    model.vis.quality.offsamples = std::min(model.vis.quality.offsamples, 2);
    mjv_defaultOption(&option_);
    mjv_defaultScene(&scene_);
    constexpr int kMostGeoms = 2000;
    mjv_makeScene(&model, &scene_, kMostGeoms);
    mjr_defaultContext(&context_);
    mjr_makeContext(&model, &context_, mjFONTSCALE_100);
    mjr_setBuffer(mjFB_OFFSCREEN, &context_);
    pixels_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
  }
  ~Renderer() {
    mjr_freeContext(&context_);
    mjv_freeScene(&scene_);
  }
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  const std::vector<std::uint8_t>& draw(PosedModel& robot, const Frame& frame) {
    mjvCamera camera = robot.camera();
    mjv_updateScene(&model_, &robot.data(), &option_, nullptr, &camera, mjCAT_ALL, &scene_);
    robot.add_forces(frame, scene_);
    mjr_render(size_, &scene_, &context_);
    mjr_readPixels(pixels_.data(), nullptr, size_, &context_);
    return pixels_;
  }

 private:
  mjModel& model_;
  mjrRect size_;
  mjvOption option_;
  mjvScene scene_;
  mjrContext context_;
  std::vector<std::uint8_t> pixels_;
};

/// Draws each frame as often as the video's pictures need it.
class Film {
 public:
  Film(const RobotConfig& robot, const std::string& folder, const Frames& frames, const std::string& path,
       const VideoOptions& options)
      : options_(options),
        pipe_(path, options.width, options.height, options.frames_a_second),
        gl_(make_offscreen_gl(options.width, options.height)),
        robot_(robot, folder + "/model.xml", frames.fields()),
        renderer_(robot_.model(), options.width, options.height) {}

  void add(const Frame& frame) {
    if (pictures_ == 0) begin_s_ = frame.time_s;
    if (frame.time_s < next_s()) return;
    robot_.pose(frame);
    const std::vector<std::uint8_t>& picture = renderer_.draw(robot_, frame);
    while (frame.time_s >= next_s()) {
      pipe_.add(picture);
      ++pictures_;
    }
  }
  std::size_t finish() {
    pipe_.finish();
    return pictures_;
  }

 private:
  double next_s() const {
    return begin_s_ + static_cast<double>(pictures_) * options_.speed / options_.frames_a_second;
  }

  VideoOptions options_;
  VideoPipe pipe_;
  std::unique_ptr<OffscreenGl> gl_;
  PosedModel robot_;
  Renderer renderer_;
  double begin_s_ = 0.0;
  std::size_t pictures_ = 0;
};

}  // namespace

VideoResult write_video(log::Reader& reader, const std::string& path, const VideoOptions& options) {
  const log::LoggedRobot logged = log::robot_in_log(reader);
  if (!logged.robot) throw std::runtime_error(reader.path() + " cannot be drawn: " + logged.missing);
  const std::string folder = logged.robot->folder.empty() ? robot_folder(logged.robot->name)
                                                          : logged.robot->folder;
  const std::string maker = log::made_by(log::find_metadata(reader));
  Frames frames(*logged.robot);
  std::optional<Film> film;  // from the first pose on: without one nothing is written
  const auto take = [&](const Frame* frame) {
    if (frame == nullptr || !frames.has_pose(*frame)) return;
    if (!film) film.emplace(*logged.robot, folder, frames, path, options);
    film->add(*frame);
  };
  log::Timeline timeline;
  for (log::Event event; reader.next(event);) {
    const double time_s = timeline.next(event).time_s;
    take(frames.add(event.channel, event.data, event.size, time_s));
  }
  take(frames.finish());
  if (!film) throw std::runtime_error(reader.path() + ": " + no_pose(frames, maker));
  return {film->finish(), version_notes(frames, maker)};
}

}  // namespace sprung::station
