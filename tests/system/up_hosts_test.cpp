/// `sprung up` on several hosts, and what others say on its network.
#include "lcmtypes/channels.h"
#include "runtime/key_source.h"
#include "runtime/resource_use.h"
#include "tests/support/paths.h"
#include "tests/system/up_fixture.h"
#include "tools/operate/launcher/launcher.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

/// The launcher's own view, in this process; what others say is made up here.
class LauncherHears : public Up {
 protected:
  LaunchRequest request() const {
    LaunchRequest request;
    request.robot = robot_.folder;
    request.simulation = true;
    request.clock = "lockstep";
    request.speed = 1.0;
    request.lcm_url = lcm_url();
    request.can = {"leg=" + can_address()};
    request.log_folder = (folder_ / "logs").string();
    return request;
  }
  /// A status as another process of that name would send it.
  static sprung_msgs::process_status_t status_of(const std::string& program, const std::string& host) {
    sprung_msgs::process_status_t status{};
    status.pid = 1;
    status.process = program;
    status.host = host;
    status.state = static_cast<std::int8_t>(ProcessState::kStopping);
    return status;
  }
  static std::vector<std::string> after(Launcher& launcher, sprung_msgs::process_status_t status) {
    Node node(NodeOptions{launcher.info().lcm_url, launcher.info().session, launcher.info().epoch_us, {}});
    std::vector<std::string> trouble;
    for (int i = 0; i < 30; ++i) {
      node.publish_message(channels::kProcessStatus, status);
      launcher.look();
      for (const std::string& text : launcher.new_trouble()) trouble.push_back(text);
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return trouble;
  }
};

TEST_F(LauncherHears, RecorderOfSprungRecordIsNotTakenForItsOwn) {
  Launcher launcher(request(), robot_);
  launcher.on_line([](const LogLine&) {});
  launcher.start_all_but_bridge();
  launcher.start_bridge();
  const std::vector<std::string> trouble = after(launcher, status_of("sprung-recorder", host_name()));
  EXPECT_EQ(launcher.rows().front().program, "sprung-recorder");
  EXPECT_NE(launcher.rows().front().pid, 1);
  EXPECT_EQ(launcher.rows().front().state, "running");
  for (const std::string& text : trouble) EXPECT_EQ(text.find("twice"), std::string::npos) << text;
}

TEST_F(LauncherHears, ProcessThatAnotherHostRunsTooIsNamed) {
  Launcher launcher(request(), robot_);
  launcher.on_line([](const LogLine&) {});
  launcher.start_all_but_bridge();
  launcher.start_bridge();
  EXPECT_THAT(
      after(launcher, status_of("sprung-motion-planner", "elsewhere")),
      testing::Contains(AllOf(HasSubstr("sprung-motion-planner runs twice"), HasSubstr("elsewhere"))));
}

/// Two launchers on one machine, each with a run folder of its own, play two hosts.
class UpOnTwoHosts : public Up {
 protected:
  void SetUp() override {
    Up::SetUp();
    const fs::path robot = folder_ / "robots" / "single_leg";
    fs::create_directories(robot);
    fs::copy(robot_.folder, robot, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
    std::string text = read_all(robot / "robot.yaml");
    const std::string planner = "{program: sprung-motion-planner,";
    const std::size_t at = text.find(planner);
    ASSERT_NE(at, std::string::npos);
    text.insert(at + planner.size(), " host: trunk,");
    std::ofstream(robot / "robot.yaml") << text;
    setenv("SPRUNG_ROBOTS", (folder_ / "robots").c_str(), 1);
    write_key_file(key_file("trunk"), *key_);
    write_key_file(key_file("lead"), *key_);
  }
  void TearDown() override {
    if (trunk_) trunk_->stop(10.0);
    Up::TearDown();
    unsetenv("SPRUNG_ROBOTS");
  }
  void start_trunk(const std::string& more = "") {
    trunk_ = std::make_unique<ChildProcess>(
        "/bin/sh", std::vector<std::string>{
                       "-c", "exec " + test::bin_dir() +
                                 "/sprung up single_leg --sim --clock lockstep --no-record --host trunk"
                                 " --instance trunk --key-file " +
                                 key_file("trunk") + " --lcm-url '" + lcm_url() + "' " + more + " > " +
                                 (folder_ / "trunk.txt").string() + " 2>&1"});
  }
  /// The copy of that host.
  std::string key_file(const std::string& host) const { return (folder_ / (host + ".key")).string(); }
  std::string lead_key() const { return "--key-file " + key_file("lead") + " "; }
  std::string trunk_said() const { return read_all(folder_ / "trunk.txt"); }
  const std::shared_ptr<const MessageKey> key_ = random_key();
  std::unique_ptr<ChildProcess> trunk_;
};

TEST_F(UpOnTwoHosts, EachStartsItsOwnAndTheSecondEndsWithTheFirst) {
  start_trunk();
  up("lockstep", lead_key() + "--speed 2");
  EXPECT_EQ(pid_of("sprung-motion-planner"), 0) << "the planner is the other host's";
  EXPECT_TRUE(within(kTimeout_s, [&] {
    return trunk_said().find("is up: 1 processes") != std::string::npos;
  })) << trunk_said();
  const CommandResult stand = sprung("stand");
  EXPECT_EQ(stand.status, 0) << stand.output;
  EXPECT_EQ(sprung("down").status, 0);
  EXPECT_TRUE(trunk_->wait(kTimeout_s)) << "it goes on without its lead";
}

TEST_F(UpOnTwoHosts, RobotOfSeveralHostsNeedsOneKeyForAll) {
  const CommandResult refused = sprung("up single_leg --sim --clock lockstep --no-record");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.output,
              AllOf(HasSubstr("several hosts"), HasSubstr("scp -p"), HasSubstr("--key-file")));
}

TEST_F(UpOnTwoHosts, HostsOfDifferentKeysDoNotObeyEachOther) {
  write_key_file(key_file("trunk"), *random_key());
  start_trunk();
  up("lockstep", lead_key() + "--speed 2");
  EXPECT_TRUE(within(kTimeout_s, [&] {
    return sprung("status --instance trunk").output.find("JOINT_STATE refused: forged") != std::string::npos;
  })) << sprung("status --instance trunk").output;
  EXPECT_NE(sprung("stand").status, 0);
}

TEST_F(UpOnTwoHosts, HostThatIsMissingIsNamedWithWhatToTypeThere) {
  EXPECT_THAT([&] { up("lockstep", lead_key() + "--timeout 5"); },
              testing::ThrowsMessage<std::runtime_error>(
                  AllOf(HasSubstr("sprung-motion-planner is not ready"),
                        HasSubstr("sprung up single_leg --host trunk"), HasSubstr("ttl"))));
}

TEST_F(UpOnTwoHosts, AnotherRobotFileOnTheSecondHostIsRefusedAndNamed) {
  start_trunk("--preset paper");
  EXPECT_THAT([&] { up("lockstep", lead_key() + "--timeout 3"); },
              testing::ThrowsMessage<std::runtime_error>(HasSubstr("sprung-motion-planner")));
  EXPECT_TRUE(trunk_->wait(kTimeout_s));
  EXPECT_THAT(trunk_said(), HasSubstr("another configuration"));
}

}  // namespace
}  // namespace sprung
