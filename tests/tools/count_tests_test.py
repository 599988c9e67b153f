# SPDX-License-Identifier: Apache-2.0
# Copyright the Swiftlet authors
"""The closing line of script/test tells the truth about what ctest wrote."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOOL = Path(__file__).resolve().parents[2] / "tools" / "count_tests.py"

PASSED = '<testcase name="passes" status="run"/>'
FAILED = '<testcase name="breaks" status="fail"><failure message=""/></testcase>'
SKIPPED = ('<testcase name="skips" status="notrun">'
           '<skipped message="SKIP_REGULAR_EXPRESSION_MATCHED"/></testcase>')
DISABLED = '<testcase name="off" status="disabled"><skipped message="Disabled"/></testcase>'
NOT_BUILT = ('<testcase name="absent" status="notrun">'
             '<skipped message="Unable to find executable: absent"/></testcase>')


def count(*reports, options=()):
    """Exit code and last line for reports made of test cases; None stands for a report that was not written."""
    with tempfile.TemporaryDirectory() as folder:
        paths = [Path(folder) / f"ctest-{i}.xml" for i in range(len(reports))]
        for path, cases in zip(paths, reports):
            if cases is not None:
                path.write_text(f"<testsuite>{''.join(cases)}</testsuite>")
        run = subprocess.run([sys.executable, TOOL, *options, *paths], capture_output=True, text=True, check=False)
    return run.returncode, run.stdout.splitlines()[-1]


class CountTests(unittest.TestCase):
    def test_sums_over_reports(self):
        self.assertEqual(count([PASSED, SKIPPED], [PASSED, DISABLED]), (0, "2 passed, 0 failed, 2 skipped"))

    def test_a_failure_fails(self):
        self.assertEqual(count([PASSED, FAILED]), (1, "1 passed, 1 failed, 0 skipped"))

    def test_a_test_that_was_not_built_is_a_failure_and_no_skip(self):
        self.assertEqual(count([PASSED, NOT_BUILT]), (1, "1 passed, 1 failed, 0 skipped"))

    def test_a_missing_report_is_a_failure(self):
        self.assertEqual(count([PASSED], None), (1, "1 passed, 1 failed, 0 skipped"))

    def test_a_run_without_tests_is_a_failure(self):
        self.assertEqual(count([PASSED], []), (1, "1 passed, 1 failed, 0 skipped"))

    def test_a_broken_stage_is_a_failure(self):
        self.assertEqual(count([PASSED], options=["--failures", "2"]), (1, "1 passed, 2 failed, 0 skipped"))

    def test_a_skipped_stage_is_a_skip(self):
        self.assertEqual(count([PASSED], options=["--skips", "1"]), (0, "1 passed, 0 failed, 1 skipped"))

    def test_nothing_passed_is_no_success(self):
        self.assertEqual(count([SKIPPED]), (1, "0 passed, 0 failed, 1 skipped"))


if __name__ == "__main__":
    unittest.main()
