#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "drivers/canopen/nmt.h"
#include "drivers/canopen/objects.h"
#include "tools/can/commands/can/can_commands.h"
#include "tools/can/commands/drive/drive_bench.h"
#include "tools/can/lss_session.h"
#include "tools/can/node_inspection.h"

namespace sprung::commands {

namespace {

using canopen::LssIdentity;

struct LssRequest {
  BusRequest where;
  std::string identity;
  int node = 0;
  int rate_kbit_s = 0;
  bool store = false;
  bool force = false;
  bool as_json = false;
};

constexpr double kBoot_s = 2.0;
constexpr double kProbe_s = 0.1;

/// The one bus that is meant, by its address or as the robot's.
class ChosenBus {
 public:
  explicit ChosenBus(const BusRequest& where) {
    if (where.robot.find(':') != std::string::npos) {
      bus_ = open_can_bus(where.robot);
      return;
    }
    bench_ = std::make_unique<DriveBench>(where);
    const std::vector<BusConfig>& buses = bench_->robot().buses;
    if (where.bus.empty() && buses.size() > 1)
      throw WrongUse(bench_->robot().name + " has " + std::to_string(buses.size()) +
                     " buses: add --bus, for example --bus " + buses.front().name);
    index_ = where.bus.empty() ? 0 : bus_index(bench_->robot(), where.bus);
  }
  CanBus& get() { return bus_ ? *bus_ : bench_->bus(index_); }

 private:
  std::unique_ptr<DriveBench> bench_;
  std::unique_ptr<CanBus> bus_;
  int index_ = 0;
};

std::optional<LssIdentity> identity_of(const LssRequest& request) {
  if (request.identity.empty()) return std::nullopt;
  const std::optional<LssIdentity> identity = parse_identity(request.identity);
  if (!identity)
    throw WrongUse(
        "--identity " + request.identity +
        ": expected VENDOR:PRODUCT:REVISION:SERIAL, four numbers, as sprung drive scan shows them");
  return identity;
}

std::vector<LssIdentity> find_all(LssSession& session) {
  std::vector<LssIdentity> found;
  while (const auto identity = session.find_next()) found.push_back(*identity);
  session.wait_all();
  return found;
}

/// The device that is meant, selected: by its identity, or the only one without a node id.
LssIdentity select_one(LssSession& session, const std::optional<LssIdentity>& wanted) {
  if (wanted) {
    session.select(*wanted);
    return *wanted;
  }
  const std::vector<LssIdentity> found = find_all(session);
  if (found.empty())
    throw std::runtime_error(
        "no device without a node id answers: name the one you mean by --identity (sprung drive scan)");
  if (found.size() > 1)
    throw std::runtime_error(std::to_string(found.size()) +
                             " devices have no node id: name one by --identity (sprung can lss find)");
  session.select(found.front());
  return found.front();
}

bool boots(CanBus& bus, int node) {
  bool heard = false;
  listen(bus, kBoot_s, [&](const CanFrame& frame) {
    heard = frame.id == canopen::heartbeat_id(node) && !frame.error && !frame.remote;
    return !heard;
  });
  return heard;
}

int run_find(const LssRequest& request) {
  ChosenBus bus(request.where);
  refuse_while_driven(bus.get(), request.force);
  LssSession session(bus.get());
  const std::vector<LssIdentity> found = find_all(session);
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const LssIdentity& identity : found) all.push_back(identity_text(identity));
  if (request.as_json) {
    std::printf("%s\n", all.dump(1).c_str());
  } else if (found.empty()) {
    std::printf("no device without a node id answers; those that have one: sprung drive scan\n");
  }
  for (const LssIdentity& identity : found) {
    if (!request.as_json) std::printf("%s  has no node id\n", identity_text(identity).c_str());
  }
  return kExitDone;
}

/// @throws std::runtime_error where the id is taken.
void require_free(CanBus& bus, int node) {
  SdoSession probe(bus, node, kProbe_s);
  if (probe.read({canopen::kDeviceType, 0}).status == canopen::SdoStatus::kTimeout) return;
  throw std::runtime_error("node id " + std::to_string(node) + " is taken on " + bus.describe() +
                           ": somebody answers there");
}

/// A device that had a node id takes the new one at NMT reset communication.
int tell_new_node(CanBus& bus, const LssRequest& request, const LssIdentity& identity, int former) {
  if (former != canopen::kNoNode) {
    const CanFrame reset = canopen::nmt_frame(canopen::NmtCommand::kResetCommunication, former);
    bus.send(&reset, 1);
  }
  const std::string text = identity_text(identity);
  if (!boots(bus, request.node)) {
    std::fprintf(stderr, "%s took node id %d and did not boot with it within %.0f s: power it off and on\n",
                 text.c_str(), request.node, kBoot_s);
    return kExitFailed;
  }
  const std::string had = former == canopen::kNoNode ? "none" : std::to_string(former);
  std::printf("%s  node id %s -> %d, booted%s\n", text.c_str(), had.c_str(), request.node,
              request.store ? ", stored" : "; not stored: gone at the next power-off (--store keeps it)");
  return kExitDone;
}

int run_node_id(const LssRequest& request) {
  if (request.node < 1 || request.node > canopen::kMaxNode)
    throw WrongUse("node id " + std::to_string(request.node) + ": expected 1..127");
  if (request.node == canopen::kBridgeNode)
    throw WrongUse("node id 127 is the bridge's own heartbeat: choose 1..126");
  const std::optional<LssIdentity> wanted = identity_of(request);
  ChosenBus chosen(request.where);
  CanBus& bus = chosen.get();
  refuse_while_driven(bus, request.force);
  require_free(bus, request.node);
  LssSession session(bus);
  const LssIdentity identity = select_one(session, wanted);
  const int former = session.node();
  session.configure_node(request.node);
  if (request.store) session.store();
  session.wait_all();
  return tell_new_node(bus, request, identity, former);
}

int run_bit_rate(const LssRequest& request) {
  if (canopen::lss_bit_rate_index(request.rate_kbit_s) < 0)
    throw WrongUse("bit rate " + std::to_string(request.rate_kbit_s) +
                   " kbit/s: expected 1000, 800, 500, 250, 125, 50, 20 or 10");
  const std::optional<LssIdentity> wanted = identity_of(request);
  ChosenBus chosen(request.where);
  refuse_while_driven(chosen.get(), request.force);
  LssSession session(chosen.get());
  const LssIdentity identity = select_one(session, wanted);
  session.configure_bit_rate(request.rate_kbit_s);
  session.store();
  std::printf("%s  %d kbit/s, stored: counts from its next power-on. Then set the interface, too\n",
              identity_text(identity).c_str(), request.rate_kbit_s);
  return kExitDone;
}

int run_store(const LssRequest& request) {
  const std::optional<LssIdentity> wanted = identity_of(request);
  ChosenBus chosen(request.where);
  refuse_while_driven(chosen.get(), request.force);
  LssSession session(chosen.get());
  const LssIdentity identity = select_one(session, wanted);
  session.store();
  std::printf("%s  node id and bit rate stored\n", identity_text(identity).c_str());
  return kExitDone;
}

CommandLine& add_part(CommandLine& lss, const char* name, const char* help,
                      const std::shared_ptr<LssRequest>& request) {
  CommandLine& part = lss.subcommand(name, help);
  part.option("robot", request->where.robot, "robot, or an address: socketcan:can0, udp:GROUP:PORT",
              Need::kRequired);
  return part;
}

void add_choices(CommandLine& part, const std::shared_ptr<LssRequest>& request) {
  part.option("--bus", request->where.bus, "which bus of the robot");
  part.option("--can", request->where.can, "another address for a bus: ADDRESS, or BUS=ADDRESS");
  part.option("--instance", request->where.instance, "of the robot that is up");
  part.flag("--force", request->force, "also while a bridge drives the bus");
}

void add_identity(CommandLine& part, const std::shared_ptr<LssRequest>& request) {
  part.option("--identity", request->identity,
              "VENDOR:PRODUCT:REVISION:SERIAL; default: the only device without a node id");
}

}  // namespace

void add_can_lss(CommandLine& can) {
  CommandLine& lss = can.subcommand(
      "lss", "Give a device its node id or bit rate by layer setting services (CiA 305).");
  lss.example("sprung can lss find socketcan:can0");

  const auto find_request = std::make_shared<LssRequest>();
  CommandLine& find = add_part(lss, "find", "Devices that have no node id, three seconds each.",
                               find_request);
  find.flag("--json", find_request->as_json, "a JSON array of identities");
  add_choices(find, find_request);
  find.example("sprung can lss find socketcan:can0");
  find.action([=] { return run_find(*find_request); });

  const auto node_request = std::make_shared<LssRequest>();
  CommandLine& node = add_part(lss, "node-id", "Give one device a node id; it boots with it.", node_request);
  node.option("node", node_request->node, "new node id, 1..126", Need::kRequired);
  add_identity(node, node_request);
  node.flag("--store", node_request->store, "the device keeps it over a power-off");
  add_choices(node, node_request);
  node.example("sprung can lss node-id socketcan:can0 5 --store");
  node.action([=] { return run_node_id(*node_request); });

  const auto rate_request = std::make_shared<LssRequest>();
  CommandLine& rate = add_part(lss, "bit-rate",
                               "Store another bit rate in one device, from its next power-on.", rate_request);
  rate.option("kbit", rate_request->rate_kbit_s, "kbit/s: 1000, 800, 500, 250, 125, 50, 20, 10",
              Need::kRequired);
  add_identity(rate, rate_request);
  add_choices(rate, rate_request);
  rate.example("sprung can lss bit-rate socketcan:can0 1000 --identity 0xFB:0x62100000:0x01260000:7");
  rate.action([=] { return run_bit_rate(*rate_request); });

  const auto store_request = std::make_shared<LssRequest>();
  CommandLine& store = add_part(lss, "store", "One device keeps its node id and bit rate over a power-off.",
                                store_request);
  add_identity(store, store_request);
  add_choices(store, store_request);
  store.example("sprung can lss store socketcan:can0 --identity 0xFB:0x62100000:0x01260000:7");
  store.action([=] { return run_store(*store_request); });
}

}  // namespace sprung::commands
