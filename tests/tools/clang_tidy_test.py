# SPDX-License-Identifier: Apache-2.0
# Copyright the Swiftlet authors
"""Plants faults that .clang-tidy must refuse: a rule that was misspelt or lost its options would let them pass."""

import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
RULES = PROJECT / ".clang-tidy"
CLANG_TIDY = os.environ.get("SWIFTLET_CLANG_TIDY", "clang-tidy-14")

CLEAN = """
#include <string>
#define SWIFTLET_ANSWER() 42
namespace swiftlet {
inline constexpr double kMaxRange_m = 12.0;
enum class Colour : unsigned char { kRed };
struct Frame { int T_world_camera = 0; };
class Counter {
 public:
  [[nodiscard]] int count() const { return count_; }
 private:
  int count_ = 0;
};
inline int twice(const Frame& frame_in) { const int T_a_b = frame_in.T_world_camera; return 2 * T_a_b; }
}  // namespace swiftlet
"""

# One fault for each family of checks, and one for each row of the naming table.
FAULTS = {
    "bugprone-use-after-move": """#include <string>\n#include <utility>
        std::size_t f(std::string a) { const std::string b = std::move(a); return a.size() + b.size(); }""",
    "bugprone-integer-division": "double f(int a) { return a / 2; }",
    "concurrency-mt-unsafe": "#include <cstdlib>\nvoid f() { std::exit(1); }",
    "cppcoreguidelines-init-variables": "int f(bool b) { int a; if (b) { a = 1; } else { a = 2; } return a; }",
    "google-explicit-constructor": "struct A { A(int a); };",
    "misc-definitions-in-headers": "",  # planted below, in a header
    "modernize-use-override": "struct A { virtual void f(); }; struct B : A { virtual void f(); };",
    "performance-unnecessary-value-param": "#include <string>\nstd::size_t f(std::string a) { return a.size(); }",
    "readability-function-size": "void g(int);\nvoid f() {\n" + "  g(1);\n" * 61 + "}",
    "readability-function-cognitive-complexity": "int f(int a) { " + "if (a > 1) { " * 7 + "++a; " + "} " * 7 + "return a; }",
    "naming of a class": "class lower_case {};",
    "naming of a function": "void camelCase();",
    "naming of a variable": "int f() { const int someValue = 1; return someValue; }",
    "naming of a private member": "class A { int member = 0; public: int get() const { return member; } };",
    "naming of a constant": "inline constexpr int max_range = 1;",
    "naming of an enumerator": "enum class Colour { red };",
    "naming of a macro": "#define ANSWER() 42",
}


def complaints(text, suffix=".cpp"):
    """The names of the checks that clang-tidy fails the text for."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "src" / "swiftlet" / ("planted" + suffix)
        file.parent.mkdir(parents=True)
        file.write_text(text)
        # As the check runs: on a file of a unity build that includes the judged ones.
        unity = Path(folder) / "unity.cxx"
        unity.write_text(f'#include "{file}"\n')
        command = [CLANG_TIDY, "--quiet", f"--config-file={RULES}", unity, "--", "-std=c++20", "-xc++"]
        run = subprocess.run(command, capture_output=True, text=True, check=False)
    found = set(re.findall(r"error: .*\[([\w.-]+)", run.stdout))
    assert bool(found) == (run.returncode != 0), run.stdout + run.stderr
    return found


class ClangTidy(unittest.TestCase):
    def test_accepts_a_clean_file(self):
        self.assertEqual(complaints(CLEAN), set())

    def test_refuses_each_planted_fault(self):
        for fault, text in FAULTS.items():
            check = "readability-identifier-naming" if fault.startswith("naming") else fault
            with self.subTest(fault):
                if check == "misc-definitions-in-headers":
                    self.assertIn(check, complaints("int f() { return 1; }", ".hpp"))
                else:
                    self.assertIn(check, complaints(text))

    def test_knows_every_check_that_the_rules_name(self):
        listed = re.search(r"^Checks: >\n(.*?)^\w", RULES.read_text(), re.M | re.S)[1]
        named = set(re.findall(r"[\w-]+", listed)) - {"-"}
        run = subprocess.run([CLANG_TIDY, "--checks=*", "--list-checks"], capture_output=True, text=True, check=True)
        self.assertEqual(named - set(run.stdout.split()), set())


if __name__ == "__main__":
    # clang-tidy 14 does not read newer standard libraries; `script/check tidy` skips there for the same reason.
    if "VERSION_CODENAME=bookworm" not in Path("/etc/os-release").read_text():
        print("skipped: clang-tidy is judged on Debian 12")
        sys.exit(77)
    unittest.main()
