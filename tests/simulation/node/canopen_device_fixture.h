#pragma once
/// Nodes for tests of the device that all makes share.
#include <gtest/gtest.h>

#include "simulation/node/canopen_device.h"
#include "tests/simulation/node/node_bench.h"

namespace sprung::sim {

/// A node with the objects of a Gold.
class CanopenDeviceTest : public testing::Test, protected NodeBench {
 protected:
  CanopenDeviceTest() : NodeBench("gold") {}
};

/// With those of an EPOS2.
class EposDeviceTest : public testing::Test, protected NodeBench {
 protected:
  EposDeviceTest() : NodeBench("epos2") {}
};

}  // namespace sprung::sim
