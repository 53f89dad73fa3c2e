"""Does `cmake --install` put the program and its readers where other programs find them?"""

import os
import shutil
import subprocess
import unittest

import streams

PROJECT = """
cmake_minimum_required(VERSION 3.25)
project(user LANGUAGES C)
find_package(iogrid 0.1 REQUIRED)
add_executable(user user.c)
target_link_libraries(user PRIVATE iogrid::c)
"""
USER = """
#include <iogrid.h>

static iogrid_receiver receiver;

int main(void) {
  iogrid_init(&receiver);
  return iogrid_take(&receiver, "no message", 10) != IOGRID_NONE || receiver.dropped[IOGRID_NOT_OURS] != 1;
}
"""


def run(*command, **more) -> str:
    return subprocess.run(command, check=True, capture_output=True, text=True, timeout=120, **more).stdout


class Install(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.prefix = streams.FOLDER / "installed"
        shutil.rmtree(cls.prefix, ignore_errors=True)
        run("cmake", "--install", os.environ["BUILD"], "--prefix", cls.prefix)

    def test_program(self):
        self.assertRegex(run(self.prefix / "bin/iog", "--version"), r"^iog \d")

    def test_c_is_found_by_cmake(self):
        source, build = streams.FOLDER / "user", streams.FOLDER / "user/build"
        shutil.rmtree(source, ignore_errors=True)
        source.mkdir(parents=True)
        (source / "CMakeLists.txt").write_text(PROJECT)
        (source / "user.c").write_text(USER)
        run("cmake", "-S", source, "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}")
        run("cmake", "--build", build)
        run(build / "user")

    def test_python(self):
        packages = self.prefix / "lib/python3/dist-packages"
        said = run("/usr/bin/python3", "-B", "-c", "import iogrid; print(iogrid.__file__, iogrid.Receiver().take(b''))",
                   env={"PYTHONPATH": str(packages)}, cwd="/")
        self.assertEqual(said, f"{packages}/iogrid/__init__.py []\n")


if __name__ == "__main__":
    unittest.main()
