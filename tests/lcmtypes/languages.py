"""A program in each language that lcm-gen writes: it decodes every message, encodes it again, and says two constants.

Every class writes its program into a folder, builds it, and answers the command that runs it. The program gets a folder
with one file for each type, named after it, writes TYPE.again beside each, and prints "2 12": drive_mode_t.TORQUE and
operator_kind_t.HOLD. `inexact`: fields whose last digits a language loses."""

import os
import pathlib
import re
import shutil
import subprocess

SAYS = "2 12"


class Missing(Exception):
    """What this machine has not got for a language."""


def _need(program, package):
    if shutil.which(program) is None:
        raise Missing(f"no {program} here: {package}")
    return program


def _built(*words, folder):
    done = subprocess.run([str(word) for word in words], cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, f"{' '.join(map(str, words))}\n{done.stdout}{done.stderr}"


def _each(line, types):
    return "\n".join(line.replace("TYPE", name) for name in types)


_C_FILES = r"""
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
static unsigned char data[1 << 22], again[1 << 22];
static long read_all(const char* folder, const char* type) {
  char path[4096];
  snprintf(path, sizeof path, "%s/%s", folder, type);
  FILE* file = fopen(path, "rb");
  if (!file) { perror(path); exit(1); }
  long size = (long)fread(data, 1, sizeof data, file);
  fclose(file);
  return size;
}
static void write_all(const char* folder, const char* type, long size) {
  char path[4096];
  snprintf(path, sizeof path, "%s/%s.again", folder, type);
  FILE* file = fopen(path, "wb");
  if (!file || fwrite(again, 1, (size_t)size, file) != (size_t)size) { perror(path); exit(1); }
  fclose(file);
}
"""


class C:
    options = ["--c"]

    def build(self, folder, types, lcm):
        one = """{ sprung_msgs_TYPE message; memset(&message, 0, sizeof message); long size = read_all(w[1], "TYPE");
          if (sprung_msgs_TYPE_decode(data, 0, (int)size, &message) != (int)size) { puts("TYPE"); return 1; }
          write_all(w[1], "TYPE", sprung_msgs_TYPE_encode(again, 0, sizeof again, &message));
          sprung_msgs_TYPE_decode_cleanup(&message); }"""
        main = folder / "main.c"
        includes = _each('#include "sprung_msgs_TYPE.h"', [*types, "drive_mode_t", "operator_kind_t"])
        said = 'printf("%d %d\\n", SPRUNG_MSGS_DRIVE_MODE_T_TORQUE, SPRUNG_MSGS_OPERATOR_KIND_T_HOLD);'
        main.write_text(f"{_C_FILES}{includes}\nint main(int c, char** w) {{ (void)c;\n{_each(one, types)}\n{said} return 0; }}\n")
        sources = sorted(folder.glob("*.c"))
        _built("cc", "-std=gnu99", "-Wall", "-I", folder, *lcm.c_flags, *sources, *lcm.c_libraries, "-o", "main", folder=folder)
        return ["./main"]


class Cpp:
    options = ["--cpp", "--cpp-std=c++11"]

    def build(self, folder, types, lcm):
        one = """{ sprung_msgs::TYPE message; const long size = read_all(w[1], "TYPE");
          if (message.decode(data, 0, (int)size) != (int)size) { puts("TYPE"); return 1; }
          write_all(w[1], "TYPE", message.encode(again, 0, sizeof again)); }"""
        includes = _each('#include "sprung_msgs/TYPE.hpp"', [*types, "drive_mode_t", "operator_kind_t"])
        said = 'printf("%d %d\\n", sprung_msgs::drive_mode_t::TORQUE, sprung_msgs::operator_kind_t::HOLD);'
        main = folder / "main.cpp"
        main.write_text(f"{_C_FILES}{includes}\nint main(int, char** w) {{\n{_each(one, types)}\n{said} return 0; }}\n")
        _built("c++", "-std=c++17", "-Wall", "-I", folder, *lcm.c_flags, main, *lcm.c_libraries, "-o", "main", folder=folder)
        return ["./main"]


class Python:
    options = ["--python"]

    def build(self, folder, types, lcm):
        imports = _each("from sprung_msgs import TYPE", types)
        (folder / "main.py").write_text(
            f"import pathlib, sys\nfrom sprung_msgs import drive_mode_t, operator_kind_t\n{imports}\n"
            f"folder = pathlib.Path(sys.argv[1])\nfor kind in [{', '.join(types)}]:\n"
            "    message = kind.decode((folder / kind.__name__).read_bytes())\n"
            "    (folder / f'{kind.__name__}.again').write_bytes(message.encode())\n"
            "print(drive_mode_t.TORQUE, operator_kind_t.HOLD)\n"
        )
        return [_need("python3", "python3"), "main.py"]


class Java:
    options = ["--java"]

    def build(self, folder, types, lcm):
        _need("javac", "default-jdk")
        if not lcm.jar.exists():
            raise Missing(f"no {lcm.jar}: liblcm-java")
        one = """    write(folder, "TYPE", new sprung_msgs.TYPE(read(folder, "TYPE")));"""
        (folder / "Main.java").write_text(
            "import java.nio.file.*;\nimport lcm.lcm.*;\npublic class Main {\n"
            "  static LCMDataInputStream read(String folder, String type) throws Exception {\n"
            "    return new LCMDataInputStream(Files.readAllBytes(Paths.get(folder, type))); }\n"
            "  static void write(String folder, String type, LCMEncodable message) throws Exception {\n"
            "    LCMDataOutputStream out = new LCMDataOutputStream(); message.encode(out);\n"
            '    Files.write(Paths.get(folder, type + ".again"), out.toByteArray()); }\n'
            f"  public static void main(String[] words) throws Exception {{ String folder = words[0];\n{_each(one, types)}\n"
            '    System.out.println(sprung_msgs.drive_mode_t.TORQUE + " " + sprung_msgs.operator_kind_t.HOLD); } }\n'
        )
        _built("javac", "-nowarn", "-cp", f".:{lcm.jar}", "Main.java", folder=folder)
        return ["java", "-cp", f".:{lcm.jar}", "Main"]


class CSharp:
    """With LCM's own classes for it, which no package has: from Debian's source of LCM 1.3.1, for either lcm-gen."""

    options = ["--csharp", "--csharp-strip-dirs"]
    runtime = ["LCMEncodable.cs", "LCMDataInputStream.cs", "LCMDataOutputStream.cs"]

    def build(self, folder, types, lcm):
        _need("mcs", "mono-mcs")
        _need("mono", "mono-runtime")
        sources = pathlib.Path(os.environ.get("LCM_DOTNET", ""))
        if not (sources / "lcm").is_dir():
            raise Missing("no source of LCM from Debian")
        one = """    write(words[0], "TYPE", new sprung_msgs.TYPE(new LCMDataInputStream(File.ReadAllBytes(Path.Combine(words[0], "TYPE")))));"""
        (folder / "Main.cs").write_text(
            "using System;\nusing System.IO;\nusing System.Linq;\nusing LCM.LCM;\npublic class Again {\n"
            "  static void write(string folder, string type, LCMEncodable message) {\n"
            "    LCMDataOutputStream data = new LCMDataOutputStream(); message.Encode(data);\n"
            '    File.WriteAllBytes(Path.Combine(folder, type + ".again"), data.Buffer.Take(data.Length).ToArray()); }\n'
            f"  public static void Main(string[] words) {{\n{_each(one, types)}\n"
            '    Console.WriteLine(sprung_msgs.drive_mode_t.TORQUE + " " + sprung_msgs.operator_kind_t.HOLD); } }\n'
        )
        own = [sources / "lcm" / name for name in self.runtime] + [sources / "util/BitConverter.cs"]
        _built("mcs", "-r:System.Core.dll", "-nowarn:0168,0219", "-out:main.exe", "Main.cs", *own, "-recurse:sprung_msgs/*.cs", folder=folder)
        return ["mono", "main.exe"]


class Lua:
    """Debian's LCM library for Lua serves what either lcm-gen writes. Its numbers are doubles."""

    options = ["--lua"]
    inexact = {"configuration_hash", "types_hash"}

    def build(self, folder, types, lcm):
        lua = _need("lua5.2", "lua5.2")
        if not pathlib.Path("/usr/lib/lua/5.2/lcm.so").exists():
            raise Missing("no LCM for Lua: liblcm-lua")
        names = ", ".join(f'"{name}"' for name in types)
        (folder / "main.lua").write_text(
            'package.path = "./?.lua;./?/init.lua;" .. package.path\nlocal msgs = require("sprung_msgs")\n'
            f"for _, name in ipairs({{{names}}}) do\n"
            '  local file = assert(io.open(arg[1] .. "/" .. name, "rb"))\n  local data = file:read("*a")\n  file:close()\n'
            '  local out = assert(io.open(arg[1] .. "/" .. name .. ".again", "wb"))\n'
            "  out:write(msgs[name].decode(data):encode())\n  out:close()\nend\n"
            "print(msgs.drive_mode_t.TORQUE .. ' ' .. msgs.operator_kind_t.HOLD)\n"
        )
        return [lua, "main.lua"]


class Go:
    """With --go-fingerprint: without, lcm-gen 1.5.3 writes lists of structs whose names do not exist."""

    options = ["--go", "--go-path", ".", "--go-fingerprint"]

    def build(self, folder, types, lcm):
        _need("go", "golang-go")
        name_of = {}
        for path in (folder / "sprung_msgs").glob("*.go"):
            name_of[re.sub(r"_\d+$", "", path.stem)] = re.search(r"^type (\w+) struct", path.read_text(), re.M)[1]
        uses = "\n".join(f'\tagain(folder, "{name}", &sprung_msgs.{name_of[name]}{{}})' for name in types)
        said = f"sprung_msgs.{name_of['drive_mode_t']}_TORQUE, sprung_msgs.{name_of['operator_kind_t']}_HOLD"
        (folder / "go.mod").write_text("module example\n\ngo 1.18\n")
        (folder / "main.go").write_text(
            'package main\n\nimport (\n\t"example/sprung_msgs"\n\t"fmt"\n\t"os"\n\t"path"\n)\n\n'
            "type message interface {\n\tDecode([]byte) error\n\tEncode() ([]byte, error)\n}\n\n"
            "func check(e error) {\n\tif e != nil {\n\t\tpanic(e)\n\t}\n}\n\n"
            "func again(folder, name string, m message) {\n\tdata, e := os.ReadFile(path.Join(folder, name))\n\tcheck(e)\n"
            "\tcheck(m.Decode(data))\n\tout, e := m.Encode()\n\tcheck(e)\n"
            '\tcheck(os.WriteFile(path.Join(folder, name+".again"), out, 0o644))\n}\n\n'
            f"func main() {{\n\tfolder := os.Args[1]\n{uses}\n\tfmt.Println({said})\n}}\n"
        )
        _built("go", "build", "-o", "main", ".", folder=folder)
        return ["./main"]


LANGUAGES = [C, Cpp, Python, Java, CSharp, Lua, Go]
