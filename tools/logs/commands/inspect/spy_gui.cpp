#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "tools/logs/commands/inspect/inspect_commands.h"
#include "tools/operate/launcher/child_process.h"

namespace sprung::commands {

namespace {

namespace fs = std::filesystem;

constexpr const char* kTypesJar = "sprung_lcm_spy.jar";  // tools/logs/lcm_spy
constexpr const char* kInstall = "sudo apt-get install liblcm-java libjchart2d-java default-jre";

/// Beside the program where it was built, in share/sprung where it is installed.
fs::path types_jar() {
  const fs::path programs = program_folder();
  for (const fs::path& folder : {programs, programs.parent_path() / "share/sprung"}) {
    if (fs::exists(folder / kTypesJar)) return folder / kTypesJar;
  }
  throw std::runtime_error(
      "this build has no " + std::string(kTypesJar) +
      ": sudo apt-get install liblcm-java default-jdk-headless, then configure and build again");
}

/// Debian's place; $SPRUNG_JAVA_LIBRARIES is for an LCM that was built by hand.
std::string library_jar(const std::string& name) {
  const char* const folder = std::getenv("SPRUNG_JAVA_LIBRARIES");
  const fs::path jar = fs::path(folder != nullptr ? folder : "/usr/share/java") / name;
  if (fs::exists(jar)) return jar.string();
  throw std::runtime_error(jar.string() + " is missing: " + kInstall);
}

/// A headless Java has no windows: it would end with an exception that does not say what to do.
void require_windows(const std::string& java) {
  const fs::path home = fs::canonical(java).parent_path().parent_path();
  if (!fs::exists(home / "lib/libawt_xawt.so"))
    throw std::runtime_error(java + " is a headless Java, it has no windows: " + kInstall);
  if (std::getenv("DISPLAY") == nullptr)
    throw std::runtime_error(
        "no DISPLAY: run it on a desktop or through 'ssh -X'; 'sprung spy' needs neither");
}

/// "hip,knee": what the plug-in writes at its lines.
std::string names_of(const InspectSource& source, const std::string& list) {
  std::string out;
  for (const fields::ListNames& one : source.names) {
    for (const std::string& name : one.list == list ? one.names : std::vector<std::string>())
      out += (out.empty() ? "" : ",") + name;
  }
  return out;
}

}  // namespace

void run_spy_gui(const InspectSource& source, bool with_plots) {
  const std::string java = system_program("java", "default-jre");
  const std::string path = library_jar("lcm.jar") + ":" + library_jar("jchart2d.jar") + ":" +
                           types_jar().string();
  require_windows(java);
  // Debian's own lcm-spy passes options that its Java 17 refuses (facts L16); this is what it would run.
  std::vector<std::string> arguments{java,
                                     "-Djava.net.preferIPv4Stack=true",
                                     "-Dsprung.joints=" + names_of(source, "joints"),
                                     "-Dsprung.legs=" + names_of(source, "legs"),
                                     std::string("-Dsprung.open=") + (with_plots ? "true" : "false"),
                                     "-cp",
                                     path,
                                     "lcm.spy.Spy"};
  std::vector<char*> pointers;
  pointers.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  setenv("LCM_DEFAULT_URL", source.url.c_str(), 1);
  execv(java.c_str(), pointers.data());
  throw std::runtime_error(java + " does not start");
}

}  // namespace sprung::commands
