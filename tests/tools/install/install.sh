#!/usr/bin/env bash
# cmake --install into an empty folder works from there, and from wherever that folder is moved: robots are
# found, completion and manual page are whole, the unit names the program, and somebody's own program
# (examples/torque_estimate) is built with find_package and gets the same torques as the robot's own
# estimator.
# usage: install.sh BUILD_DIR SOURCE_DIR
set -euo pipefail
build=$1 source_dir=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
complain() { echo "FAILED: $*"; exit 1; }
there=$work/first/prefix
DESTDIR= cmake --install "$build" --prefix "$there" >/dev/null
grep -q "^ExecStart=$there/bin/sprung up %i" "$there/lib/systemd/system/sprung@.service" || complain "the unit does not follow --prefix"
# A package is put together below a folder that is not part of its paths.
DESTDIR=$work/staged cmake --install "$build" --prefix /opt/sprung --component programs >/dev/null
grep -q "^ExecStart=/opt/sprung/bin/sprung up %i" "$work/staged/opt/sprung/lib/systemd/system/sprung@.service" || complain "the unit names DESTDIR"

mkdir "$work/second"
mv "$there" "$work/second/moved"
there=$work/second/moved
sprung=$there/bin/sprung
unset SPRUNG_ROBOTS SPRUNG_PROGRAMS
"$sprung" --version
for file in share/bash-completion/completions/sprung share/man/man1/sprung.1 share/sprung/robots/pegasus/robot.yaml \
  share/sprung/lcmtypes/joint_state.lcm include/sprung/sprung_msgs/joint_state_t.hpp; do
  [ -s "$there/$file" ] || complain "not installed: $file"
done
bash --norc -c "source $there/share/bash-completion/completions/sprung; COMP_WORDS=(sprung up peg); COMP_CWORD=2; _sprung; [ \"\${COMPREPLY[*]}\" = pegasus ]" ||
  complain "completion does not know pegasus"
said=$("$sprung" up no_such_robot 2>&1 || true)
[[ $said == *"$there/share/sprung/robots"* ]] || complain "robots are not looked for in the installation: $said"

# Program, robots and message definitions of different releases are refused before anything starts.
cp "$there/share/sprung/release" "$work/release"
sed -i 's/^message_types: .*/message_types: 0123456789abcdef/' "$there/share/sprung/release"
said=$("$sprung" up test_axis --sim --no-record --instance "install-$$" 2>&1 || true)
[[ $said == *"$there/share/sprung/release has message_types 0123456789abcdef"* ]] || complain "another release is not refused: $said"
cp "$work/release" "$there/share/sprung/release"

# Every header that is installed can be included, without a warning, and without the source tree.
(cd "$there/include" && find sprung -name '*.h' | sort | sed 's/.*/#include <&>/') >"$work/all.cpp"
[ "$(wc -l <"$work/all.cpp")" -gt 50 ] || complain "hardly any header is installed"
[ ! -e "$there/include/sprung/robots/pegasus" ] || complain "folders without a header are installed"
! grep -q "$source_dir" -r "$there/lib/cmake" || complain "the CMake package names the source tree"

# Somebody's own program, and one that uses every target.
cp -r "$source_dir/examples/torque_estimate" "$work/own"
cat >>"$work/own/CMakeLists.txt" <<EOT
find_package(sprung 0.1 REQUIRED COMPONENTS messages)
add_executable(whole $work/all.cpp $work/main.cpp)
target_compile_options(whole PRIVATE -Wall -Wextra -O0)
target_link_libraries(whole PRIVATE sprung::model sprung::controller sprung::messages)
file(WRITE \${CMAKE_BINARY_DIR}/folders "\${sprung_ROBOTS_DIR} \${sprung_LCMTYPES_DIR}")
EOT
cat >"$work/main.cpp" <<'EOT'
#include <sprung/controller/controller_core.h>
#include <sprung/model/leg_kinematics.h>
#include <sprung/robots/robot_loader.h>
#include <sprung/signals/drive_state.h>
#include <sprung/signals/messages.h>

#include <sprung_msgs/drive_state_t.hpp>

int main() {
  const sprung::RobotConfig robot = sprung::load_robot("single_leg");
  const sprung::ControllerCore controller(robot, robot.preset(), robot.watchdogs);
  sprung_msgs::drive_state_t message;
  sprung::to_message(sprung::DriveState(robot.actuators.size()), 1, message);
  const int joints = sprung::make_leg_kinematics(robot.legs[0])->joint_count();
  return joints == 2 && message.n == 2 ? 0 : 1;
}
EOT
cmake -S "$work/own" -B "$work/own/build" -G Ninja -DCMAKE_PREFIX_PATH="$there" >"$work/said" 2>&1 &&
  cmake --build "$work/own/build" >>"$work/said" 2>&1 || { cat "$work/said"; complain "find_package(sprung) does not work"; }
! grep -i "warning" "$work/said" || complain "warnings for whoever includes the headers"
[ "$(cat "$work/own/build/folders")" = "$there/share/sprung/robots $there/share/sprung/lcmtypes" ] || complain "the package does not know its folders"
SPRUNG_ROBOTS=$there/share/sprung/robots "$work/own/build/whole" || complain "a program with every target fails"
said=$(cd "$work" && mkdir newer && printf 'cmake_minimum_required(VERSION 3.22)\nproject(newer CXX)\nfind_package(sprung 9.0 REQUIRED)\n' >newer/CMakeLists.txt &&
  cmake -S newer -B newer/build -DCMAKE_PREFIX_PATH="$there" 2>&1 || true)
[[ $said == *"requested version"* ]] || complain "a version that is not there is not refused: $said"

# What it says of a robot's drives is what the robot's own estimator said, to the last bit. The robot is in
# one process, so that no cycle is missed, and it moves.
"$sprung" experiment --logs "$work" drag --robot test_axis >"$work/said" 2>&1 || true   # its rows are not asked for here
log=$work/test_axis-000.lcm
[ -s "$log" ] || { cat "$work/said"; complain "no log of a robot"; }
csv() { "$sprung" log csv "$log" --to 8 "$@" | tail -n +2 | cut -d, -f3-; }   # without time and cycle
csv --fields DRIVE_STATE.utime --fields 'DRIVE_STATE.actuators[0].measured_position_rad' --fields 'DRIVE_STATE.actuators[0].measured_current_A' >"$work/in.csv"
csv --fields JOINT_STATE.utime --fields 'JOINT_STATE.joints[0].motor_side_torque_Nm' --fields 'JOINT_STATE.joints[0].gear_output_torque_Nm' >"$work/logged.csv"
SPRUNG_ROBOTS=$there/share/sprung/robots "$work/own/build/torque_estimate" test_axis <"$work/in.csv" >"$work/own.csv"
awk -F, 'NR == FNR { for (i = 1; i <= 3; ++i) logged[FNR, i] = $i; rows = FNR; next }
  { for (i = 1; i <= 3; ++i) if ($i + 0 != logged[FNR, i] + 0) { print "line " FNR ": " $0 ", logged " logged[FNR, i]; exit 1 } }
  $3 > 1e-6 || $3 < -1e-6 { ++torques }
  END { if (FNR != rows || torques < 7000) { print FNR " lines, " rows " logged, " torques + 0 " with a torque"; exit 1 } }' \
  "$work/logged.csv" "$work/own.csv" || complain "the torques are not the ones that were logged"
echo "installed; $(wc -l <"$work/own.csv") cycles of one's own program agree with the log"
