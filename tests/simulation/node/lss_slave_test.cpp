/// Layer setting services of the simulated device, as sprung's own master uses them and frame by frame:
/// lss_slave.h, and what CanopenDevice makes of it. tests/conformance/test_lss.py has python-canopen's
/// master.
#include "simulation/node/lss_slave.h"

#include <gtest/gtest.h>

#include "drivers/canopen/lss_master.h"
#include "tests/simulation/node/node_bench.h"

namespace sprung::sim {
namespace {

using canopen::LssCommand;
using canopen::LssMode;
using canopen::LssStatus;

DevicePolicy with_lss(int factory_node) {
  DevicePolicy policy;
  policy.lss = true;
  policy.factory_node = factory_node;
  return policy;
}

class LssBench : public NodeBench {
 public:
  explicit LssBench(int factory_node) : NodeBench("epos2", with_lss(factory_node)) {
    dictionary.set({0x1018, 4}, 0x0A1B2C3D);
  }
  LssStatus run() {
    CanFrame request;
    for (int turn = 0; turn < 100'000 && master.status() == LssStatus::kBusy; ++turn) {
      drop();
      while (master.step(time_us, request)) receive(request);
      for (const CanFrame& reply : frames(canopen::kLssSlaveId)) master.receive(reply);
      time_us += 1000;
    }
    return master.status();
  }
  canopen::LssIdentity identity() {
    canopen::LssIdentity numbers;
    for (std::uint8_t i = 0; i < 4; ++i)
      numbers[i] = static_cast<std::uint32_t>(dictionary.get({0x1018, static_cast<std::uint8_t>(i + 1)}));
    return numbers;
  }
  canopen::LssMaster master;
};

TEST(LssSlave, ADeviceWithoutNodeIdIsSilent) {
  LssBench bench(canopen::kNoNode);
  EXPECT_EQ(bench.out.size(), 0);
  bench.nmt(canopen::NmtCommand::kStart, 0);
  bench.receive(canopen::sdo_read_request(NodeBench::kNode, {0x1000, 0}));
  bench.receive(canopen::sync_frame());
  bench.dictionary.set({0x1017, 0}, 10);
  bench.tick_until(500'000);
  bench.node.raise(0x2310);
  EXPECT_EQ(bench.out.size(), 0);
  EXPECT_FALSE(bench.node.operational());
}

TEST(LssSlave, FastscanFindsItAndItBootsWithItsNewNode) {
  LssBench bench(canopen::kNoNode);
  bench.master.fastscan();
  ASSERT_EQ(bench.run(), LssStatus::kDone);
  EXPECT_EQ(bench.master.identity(), bench.identity());
  bench.master.configure_node(42);
  ASSERT_EQ(bench.run(), LssStatus::kDone);
  bench.master.switch_all(LssMode::kWaiting);
  ASSERT_EQ(bench.run(), LssStatus::kDone);
  EXPECT_EQ(bench.frames(0x700 + 42).size(), 1u);
  EXPECT_EQ(bench.node.node(), 42);
  bench.drop();
  bench.receive(canopen::sdo_read_request(42, {0x1800, 1}));
  ASSERT_EQ(bench.frames(0x580 + 42).size(), 1u);
  EXPECT_EQ(bench.dictionary.get({0x1800, 1}) & 0x7FF, 0x180 + 42);
  EXPECT_EQ(bench.dictionary.get({0x1014, 0}) & 0x7FF, 0x080 + 42);
}

TEST(LssSlave, OneThatHasANodeIdTakesNoPartInAFastscan) {
  LssBench bench(0);
  bench.master.fastscan();
  EXPECT_EQ(bench.run(), LssStatus::kNobody);
}

TEST(LssSlave, ConfiguredNodeCountsAfterResetCommunication) {
  LssBench bench(0);
  bench.master.select(bench.identity());
  ASSERT_EQ(bench.run(), LssStatus::kDone);
  bench.master.inquire_node();
  ASSERT_EQ(bench.run(), LssStatus::kDone);
  EXPECT_EQ(bench.master.value(), static_cast<std::uint32_t>(NodeBench::kNode));
  bench.master.configure_node(9);
  ASSERT_EQ(bench.run(), LssStatus::kDone);
  bench.master.switch_all(LssMode::kWaiting);
  bench.run();
  EXPECT_EQ(bench.node.node(), NodeBench::kNode);
  bench.drop();
  bench.nmt(canopen::NmtCommand::kResetCommunication);
  EXPECT_EQ(bench.frames(0x709).size(), 1u);
  EXPECT_EQ(bench.node.node(), 9);
}

TEST(LssSlave, OnlyWhatIsStoredOutlivesPower) {
  LssBench bench(0);
  bench.master.select(bench.identity());
  ASSERT_EQ(bench.run(), LssStatus::kDone);
  bench.master.configure_node(9);
  ASSERT_EQ(bench.run(), LssStatus::kDone);
  bench.node.power_cycle();
  bench.tick_until(1'000'000);
  EXPECT_EQ(bench.node.node(), NodeBench::kNode);
  for (const bool stored : {false, true}) {
    bench.master.select(bench.identity());
    ASSERT_EQ(bench.run(), LssStatus::kDone) << stored;
    bench.master.configure_node(9);
    ASSERT_EQ(bench.run(), LssStatus::kDone);
    if (stored) {
      bench.master.store();
      ASSERT_EQ(bench.run(), LssStatus::kDone);
    }
    bench.node.power_cycle();
    bench.tick_until(bench.time_us + 1'000'000);
    EXPECT_EQ(bench.node.node(), stored ? 9 : NodeBench::kNode);
  }
}

TEST(LssSlave, WrongIdentitySelectsNobody) {
  LssBench bench(0);
  for (std::size_t part = 0; part < 4; ++part) {
    canopen::LssIdentity wrong = bench.identity();
    wrong[part] ^= 1;
    bench.master.select(wrong);
    EXPECT_EQ(bench.run(), LssStatus::kTimeout) << part;
  }
  bench.master.configure_node(9);
  EXPECT_EQ(bench.run(), LssStatus::kTimeout);  // it waits still
}

TEST(LssSlave, NumbersOutOfOrderSelectNobody) {
  LssBench bench(0);
  const canopen::LssIdentity numbers = bench.identity();
  bench.drop();
  for (const int part : {0, 2, 1, 3})
    bench.receive(canopen::lss_select_request(part, numbers[static_cast<std::size_t>(part)]));
  EXPECT_TRUE(bench.frames(canopen::kLssSlaveId).empty());
}

TEST(LssSlave, BadNodesAndBitRatesAreRefused) {
  LssBench bench(0);
  bench.master.switch_all(LssMode::kConfiguration);
  bench.run();
  for (const int node : {0, 128, 254}) {
    bench.master.configure_node(node);
    EXPECT_EQ(bench.run(), LssStatus::kRefused) << node;
    EXPECT_EQ(bench.master.error(), 1);
  }
  for (const int index : {5, 9, 255}) {
    bench.master.configure_bit_rate(index);
    EXPECT_EQ(bench.run(), LssStatus::kRefused) << index;
  }
  bench.master.configure_bit_rate(2);
  EXPECT_EQ(bench.run(), LssStatus::kDone);
  EXPECT_EQ(bench.node.node(), NodeBench::kNode);
}

TEST(LssSlave, ADeviceWithoutLssHearsNothing) {
  NodeBench bench("gold");
  bench.drop();
  bench.receive(canopen::lss_request(LssCommand::kSwitchAll, 1));
  bench.receive(canopen::lss_request(LssCommand::kInquireNode));
  EXPECT_EQ(bench.out.size(), 0);
}

}  // namespace
}  // namespace sprung::sim
