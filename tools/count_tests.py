#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright the Swiftlet authors
"""Sums the JUnit files that ctest wrote into one line, "N passed, N failed, N skipped".

Exit code 1 if anything failed, or nothing passed. A report that is missing or empty counts as one failure, and so
does each of --failures (stages that broke without a test to blame) and --skips (stages that do not apply here).
"""

import argparse
import sys
import xml.etree.ElementTree as xml
from pathlib import Path

# What ctest writes for a test that skipped itself or was switched off; any other reason not to run is a failure.
SKIPS = ("SKIP_RETURN_CODE", "SKIP_REGULAR_EXPRESSION", "Disabled")


def verdict(case):
    """One of passed, failed, skipped for a <testcase>."""
    status = case.get("status")
    if status == "run":
        return "passed"
    skipped = case.find("skipped")
    reason = skipped.get("message", "") if skipped is not None else ""
    is_skip = status == "disabled" or (status == "notrun" and reason.startswith(SKIPS))
    return "skipped" if is_skip else "failed"


def count(reports, failures=0, skips=0):
    """Totals over the reports and the names of what failed."""
    totals = {"passed": 0, "failed": failures, "skipped": skips}
    failed = []
    for report in reports:
        try:
            cases = xml.parse(report).getroot().findall("testcase")
        except (OSError, xml.ParseError) as error:
            totals["failed"] += 1
            failed.append(f"{report}: no report ({error})")
            continue
        if not cases:
            totals["failed"] += 1
            failed.append(f"{report.stem}: ran no tests")
        for case in cases:
            totals[verdict(case)] += 1
            if verdict(case) == "failed":
                failed.append(f"{report.stem}: {case.get('name')}")
    return totals, failed


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--failures", type=int, default=0)
    parser.add_argument("--skips", type=int, default=0)
    parser.add_argument("reports", nargs="*", type=Path)
    options = parser.parse_args()
    totals, failed = count(options.reports, options.failures, options.skips)
    for name in failed:
        print(f"FAILED {name}")
    print(f"{totals['passed']} passed, {totals['failed']} failed, {totals['skipped']} skipped")
    return 0 if totals["failed"] == 0 and totals["passed"] > 0 else 1


if __name__ == "__main__":
    sys.exit(main())
