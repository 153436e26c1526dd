#include "tools/operate/launcher/build_match.h"

#include <cstdio>

#include "robots/text_hash.h"

namespace sprung {
namespace {

constexpr const char*
    kRebuild = "build and install the same commit everywhere: cmake --build --preset release";
constexpr const char* kSameFile = "copy one robot.yaml to every host, and give every host the same --preset";

std::string sentence(const sprung_msgs::process_status_t& who, const std::string& what,
                     const std::string& theirs, const std::string& ours, const char* remedy) {
  return who.process + " on " + who.host + " has another " + what + ": " + theirs + ", here " + ours + "; " +
         remedy;
}

}  // namespace

BuildIdentity identity_of(const sprung_msgs::process_status_t& status) {
  return {status.version, status.git_hash, status.types_hash, status.configuration_hash,
          status.robot,   status.clock};
}

std::string why_not_together(const BuildIdentity& ours, const sprung_msgs::process_status_t& who,
                             bool mixed_builds) {
  const BuildIdentity theirs = identity_of(who);
  if (theirs.version != ours.version) return sentence(who, "version", theirs.version, ours.version, kRebuild);
  if (theirs.types_hash != ours.types_hash)
    return sentence(who, "set of message types", hash_digits(theirs.types_hash), hash_digits(ours.types_hash),
                    kRebuild);
  if (theirs.git_hash != ours.git_hash && !mixed_builds)
    return sentence(who, "build", theirs.git_hash, ours.git_hash, kRebuild) +
           " (SPRUNG_MIXED_BUILDS=1 lets it run while you develop)";
  if (theirs.robot != ours.robot) return sentence(who, "robot", theirs.robot, ours.robot, kSameFile);
  if (theirs.configuration_hash != ours.configuration_hash)
    return sentence(who, "configuration", hash_digits(theirs.configuration_hash),
                    hash_digits(ours.configuration_hash), kSameFile);
  if (theirs.clock != ours.clock)
    return sentence(who, "clock", theirs.clock, ours.clock, "give every host the same --clock");
  return "";
}

}  // namespace sprung
