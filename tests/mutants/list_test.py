#!/usr/bin/env python3
"""Every mutant's text stands once in its file; and the list and the switches on small texts."""

import sys
import unittest

import mutants

SMALL = """
# a comment
file a.cpp
campaign drive bus on pegasus
one: the first rule
- a <   b
+ false
two: another
- if («c»)
-   d();
+ true
unseen: the next gate
  tells
file b.h
campaign none: nobody there
three: a call
- e();
+
"""


class List(unittest.TestCase):
    def test_every_text_stands_once_in_its_file(self):
        by_file = {}
        for mutant in mutants.listed():
            self.assertTrue(mutant.what and (mutant.campaign or mutant.unseen), mutant.name)
            by_file.setdefault(mutant.file, []).append(mutant)
        for file, of_file in by_file.items():
            mutants.with_switches((mutants.TOP / file).read_text("utf-8"), of_file)

    def test_fields(self):
        one, two, three = mutants.parsed(SMALL.replace("\n  tells", ""))
        self.assertEqual((one.before, one.after, one.campaign), ("a <   b", "false", ["drive", "bus"]))
        self.assertEqual((one.robots, three.robots), (("single_leg", "pegasus"), ()))
        self.assertEqual((two.before, two.unseen), ("if («c»)\nd();", "the next gate"))
        self.assertEqual((three.after, three.campaign, three.unseen), ("", [], "nobody there"))

    def test_what_it_does_not_know_is_an_error(self):
        for text in (SMALL, "one: without a file\n", "file a.cpp\nnonsense\n"):
            with self.assertRaises(mutants.WrongList):
                mutants.parsed(text)


def mutant(before, after="false", name="m"):
    return mutants.Mutant(name, "", "a.cpp", [], before, after)


class Switches(unittest.TestCase):
    def test_expression_and_statement(self):
        number = mutant("").number
        text = mutants.with_switches("if (a\n    < b) c();", [mutant("a < b")])
        self.assertEqual(text, mutants.INCLUDE + f"if ((sprung_mutant({number}) ? (false) : (a\n    < b))) c();")
        text = mutants.with_switches("#pragma once\nc();", [mutant("c();", "")])
        self.assertEqual(
            text, f"#pragma once\n{mutants.INCLUDE}{{ if (sprung_mutant({number})) {{  }} else {{ c(); }} }}"
        )

    def test_part_of_a_text(self):
        text = mutants.with_switches("if (a) b(); if (a) c();", [mutant("if («a») c();")])
        self.assertTrue(text.startswith(mutants.INCLUDE + "if (a) b(); if ((sprung"))

    def test_one_within_another_and_two_of_one_place(self):
        outer, inner, same = mutant("a && b"), mutant("«b»)", name="n"), mutant("a && b", "a", name="o")
        text = mutants.with_switches("if (a && b)", [outer, inner, same])
        self.assertEqual(text.count("sprung_mutant("), 3)
        self.assertEqual(text.count("(a && (sprung_mutant"), 1)

    def test_not_once_or_overlapping_is_an_error(self):
        for source, of_file in (
            ("a b a", [mutant("a")]),
            ("b", [mutant("a")]),
            ("a", [mutant("")]),
            ("a b c", [mutant("a b"), mutant("b c", name="n")]),
        ):
            with self.assertRaisesRegex(mutants.WrongList, "a.cpp: "):
                mutants.with_switches(source, of_file)


if __name__ == "__main__":
    sys.exit(unittest.main())
