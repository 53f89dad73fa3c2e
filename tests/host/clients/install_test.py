"""Does `cmake --install` put the program and its readers where other programs find them, and the Debian package, too?"""

import gzip
import os
import pty
import re
import shutil
import subprocess
import unittest

import streams
from c_test import READER, compile_to, program, said_by

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


class Bash:
    """An interactive bash in a folder, with the completion and the iog of a prefix."""

    def __init__(self, folder, prefix):
        self.result = folder.parent / "completed.txt"
        self.master, slave = pty.openpty()
        self.process = subprocess.Popen(
            ["bash", "--noprofile", "--norc", "-i"], stdin=slave, stdout=slave, stderr=slave, cwd=folder, start_new_session=True,
            env={"PATH": f"{prefix}/bin:/usr/bin:/bin", "PS1": "command \\#> ", "TERM": "dumb", "INPUTRC": "/dev/null"})
        os.close(slave)
        self.commands = 0
        self.until_ready()
        self.type(f"source {prefix}/share/bash-completion/completions/iog\n")

    def until_ready(self):
        self.commands += 1
        said = b""
        while not said.endswith(b"command %d> " % self.commands):
            said += os.read(self.master, 4096)

    def type(self, keys):
        os.write(self.master, keys.encode())
        self.until_ready()

    def completed(self, line) -> list[str]:
        """The words behind `iog` when Alt-* has inserted all completions of the line's last word."""
        self.type(f"iog {line}\033*\001printf '%s\\n' \005 >{self.result}\n")
        return self.result.read_text().splitlines()[1:]

    def end(self):
        os.close(self.master)
        self.process.wait(timeout=60)


class Install(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        staged = streams.FOLDER / "installed"
        shutil.rmtree(staged, ignore_errors=True)
        run("cmake", "--install", os.environ["BUILD"], "--prefix", "/usr", env={**os.environ, "DESTDIR": str(staged)})
        cls.prefix = staged / "usr"

    def test_program(self):
        self.assertRegex(run(self.prefix / "bin/iog", "--version"), r"^iog \d")

    def test_manual_has_each_command_and_option(self):
        iog, folder = self.prefix / "bin/iog", self.prefix / "share/man/man1"
        commands = re.findall(r"^  ([a-z][a-z-]*)  ", run(iog, "--help"), re.M)
        self.assertIn("fuse", commands)
        pages = {f"iog-{name}": run(iog, name, "--help") for name in commands} | {"iog": run(iog, "--help")}
        self.assertEqual({f"{name}.1.gz" for name in pages}, {path.name for path in folder.iterdir()})
        for name, said in pages.items():
            page = gzip.decompress((folder / f"{name}.1.gz").read_bytes()).decode().replace("\\-", "-")
            self.assertRegex(page, rf"^\.TH \"{name.upper()}\" 1 ")
            self.assertEqual(run(iog, "help", *name.split("-", 1)[1:]), said)
            for option in re.findall(r"^  -[^ ]+", said, re.M):
                self.assertIn(f"\n.TP\n.B {option.strip()}", page)

    def test_bash_completes(self):
        """Commands, options, values, cars and files by ending, as bash inserts them for Alt-*."""
        folder = streams.FOLDER / "completed"
        shutil.rmtree(folder, ignore_errors=True)
        (folder / "drives").mkdir(parents=True)
        for name in ("one.pcap", "notes.txt", "my car.toml", "town.osm.pbf"):
            (folder / name).touch()
        cars = sorted(path.stem for path in (streams.ROOT / "vehicles").glob("roof_x*.toml"))
        expected = {
            "re": ["receive", "record", "relay", "replay"], "help rel": ["relay"], "fuse --classes-p": ["--classes-png"],
            "record --str": ["--stream"], "fuse --rule b": ["bayes"], "fuse --rule=b": ["--rule=bayes"],
            "fuse --vehicle roof_x": cars, "vehicles --ports roof_x": cars, "view --simulate ri": ["ring_road"],
            "points --time-unit n": ["ns"], "fuse --pcap ": ["drives", "one.pcap"], "fuse --pcap one.pcap dri": ["drives"],
            "fuse --vehicle-file m": ["my car.toml"], "fuse --out ": ["drives"], "image --vehicle roof_xt16 t": ["town.osm.pbf"],
            "simulate --town ": ["drives", "town.osm.pbf"], "fuse --frame o": ["o"], "fuse --moving": ["--moving"]}
        bash = Bash(folder, self.prefix)
        for line, words in expected.items():
            self.assertEqual(bash.completed(line), [*line.split()[:-1 if line[-1] != " " else None], *words], line)
        bash.end()

    def test_documents_and_examples(self):
        folder = self.prefix / "share/doc/iogrid"
        for name in ("LICENSE", "docs/foxglove_layout.json", "docs/wireshark/iogrid.lua",
                     "vehicles/reference_car.toml", "clients/ros2/iogrid_node.py"):
            self.assertTrue((folder / name).is_file(), name)

    def test_links_of_documents(self):
        """Each relative link names an installed file, and an anchor one of its headings as GitHub spells it."""
        root = self.prefix / "share/doc/iogrid"
        texts = {page.resolve(): page.read_text() for page in root.rglob("*.md")}
        sources = list((streams.ROOT / "docs").rglob("*.md"))
        self.assertEqual(len(texts), len(sources) + 2)
        links = [(page, *link.partition("#")[::2]) for page, text in texts.items()
                 for link in re.findall(r"\]\((?!\w+:)([^)\s]+)\)", text)]
        self.assertGreater(len(links), 400)
        for page, path, anchor in links:
            target = (page.parent / path).resolve() if path else page
            self.assertTrue(target.exists(), f"{page.relative_to(root)}: {path}")
            headings = re.findall(r"^#+ (.*)$", texts.get(target, ""), re.M)
            anchors = ["", *(re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings)]
            self.assertIn(anchor, anchors, f"{page.relative_to(root)}: {path}")

    def test_debian_package(self):
        """It has what is installed and no more, asks for the libraries that iog is linked with, and its iog runs."""
        folder = streams.FOLDER / "package"
        shutil.rmtree(folder, ignore_errors=True)
        run("cpack", "-G", "DEB", "-B", folder, cwd=os.environ["BUILD"])
        (package,) = folder.glob("iogrid_*.deb")
        run("dpkg-deb", "-x", package, folder / "unpacked")
        files = [{path.relative_to(root) for path in root.rglob("*") if path.is_file()}
                 for root in (self.prefix, folder / "unpacked/usr")]
        self.assertEqual(*files)
        wanted = run("dpkg-deb", "-f", package, "Depends")
        for library in ("libc6", "libpcap0.8", "libpng16-16", "libproj25", "libzstd1", "zlib1g"):
            self.assertIn(library, wanted)
        said = run(folder / "unpacked/usr/bin/iog", "info", streams.raw())
        self.assertIn("frames                2", said)

    def test_c_is_found_by_cmake(self):
        source, build = streams.FOLDER / "user", streams.FOLDER / "user/build"
        shutil.rmtree(source, ignore_errors=True)
        source.mkdir(parents=True)
        (source / "CMakeLists.txt").write_text(PROJECT)
        (source / "user.c").write_text(USER)
        run("cmake", "-S", source, "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}")
        run("cmake", "--build", build)
        run(build / "user")

    def test_c_is_found_by_pkg_config(self):
        """Under both names of the header, in a staged folder, which the package's file does not know."""
        where = {**os.environ, "PKG_CONFIG_PATH": str(self.prefix / "share/pkgconfig")}
        flags = run("pkg-config", "--cflags", "--libs", "iogrid >= 0.1", env=where).split()
        for number, header in enumerate(("iogrid.h", "iogrid/iogrid.h")):
            user = streams.FOLDER / f"user{number}"
            user.with_suffix(".c").write_text(USER.replace("iogrid.h", header))
            run("gcc", "-Wall", "-Werror", user.with_suffix(".c"), *flags, "-o", user)
            run(user)

    def test_c_is_one_header(self):
        """To copy: it reads what those read that it is made of, which c_test compares with the Python reader."""
        (header,) = (self.prefix / "include/iogrid").iterdir()
        self.assertEqual(header.name, "iogrid.h")
        self.assertNotIn('#include "', header.read_text())
        reader, messages = streams.FOLDER / "reader_of_one", streams.messages_of(streams.simulated())
        compile_to(reader, "gcc", READER, headers=header.parent)
        self.assertEqual(said_by(reader, messages), said_by(program("gcc"), messages))
        self.assertGreater(len(said_by(reader, messages)), 5)

    def test_python(self):
        packages = self.prefix / "lib/python3/dist-packages"
        said = run("/usr/bin/python3", "-B", "-c", "import iogrid; print(iogrid.__file__, iogrid.Receiver().take(b''))",
                   env={"PYTHONPATH": str(packages)}, cwd="/")
        self.assertEqual(said, f"{packages}/iogrid/__init__.py []\n")

    def test_python_is_installed_by_pip(self):
        """From a copy of its folder, which pip writes to, without a network; its version is that of iog."""
        source, target = streams.FOLDER / "python", streams.FOLDER / "pip"
        for folder in (source, target):
            shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(streams.ROOT / "clients/python", source)
        run("/usr/bin/python3", "-m", "pip", "install", "--no-build-isolation", "--no-index", "--no-deps", "--no-compile",
            "--target", target, source)
        said = run("/usr/bin/python3", "-B", "-c", "import importlib.metadata, iogrid; "
                   "print('iog', importlib.metadata.version('iogrid'), iogrid.__file__, iogrid.Receiver().take(b''))",
                   env={"PYTHONPATH": str(target)}, cwd="/")
        version = run(self.prefix / "bin/iog", "--version").split()[1]
        self.assertEqual(said, f"iog {version} {target}/iogrid/__init__.py []\n")
        self.assertEqual({path.name for path in (target / "iogrid").iterdir()},
                         {path.name for path in (self.prefix / "lib/python3/dist-packages/iogrid").iterdir()})


if __name__ == "__main__":
    unittest.main()
