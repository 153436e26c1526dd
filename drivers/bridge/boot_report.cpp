#include "drivers/bridge/boot_report.h"

#include <cstdio>

#include "drivers/canopen/objects.h"

namespace sprung {
namespace {

std::string object_text(const Overwritten& one) {
  char id[16];
  std::snprintf(id, sizeof id, "0x%04X:%02X", one.setting.object.index, one.setting.object.sub);
  DriveSetting now = one.setting;
  now.value = one.written;
  return std::string(id) + " " + canopen::object_name(one.setting.object.index) + " (" +
         value_text(one.setting) + ", now " + value_text(now) + ")";
}

}  // namespace

void report_boot(const NodeLink& link, std::vector<std::string>& lines) {
  const NodeBoot& boot = link.boot();
  if (boot.standard_alone()) {
    char text[160];
    std::snprintf(text, sizeof text,
                  "%s: firmware 0x%08X is none that its objects were checked with: only what CiA 301 and 402 "
                  "define is written, the maker's own objects are left alone",
                  link.name().c_str(), boot.firmware());
    lines.emplace_back(text);
  }
  if (boot.guarded_instead())
    lines.push_back(link.name() +
                    ": refuses to watch the bridge's heartbeat (0x1016); node guarding does it "
                    "instead, as with watch: guarding in robot.yaml");
  std::string overwritten;
  for (const Overwritten& one : boot.overwritten())
    overwritten += (overwritten.empty() ? "" : ", ") + object_text(one);
  if (!overwritten.empty()) lines.push_back(link.name() + ": boot has overwritten " + overwritten);
}

void report_restore(const DriveNode& drive, std::vector<std::string>& lines) {
  if (!drive.actuator().restore_settings) return;
  const SettingsRestore& restore = drive.restore();
  if (restore.done() && restore.failed() == 0) {
    lines.push_back(drive.name() + ": has its settings back");
  } else {
    lines.push_back(drive.name() + ": settings are NOT all as before (" + std::to_string(restore.failed()) +
                    " refused or not answered): switch its supply off and on");
  }
}

}  // namespace sprung
