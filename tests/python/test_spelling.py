# SPDX-License-Identifier: GPL-3.0-or-later
"""The spelling of what people read: pages, help texts, and the words of the page of a run. British, with -ise, as aspell has it; terms
and names that it does not know are in tests/spelling.txt."""
import re
import shutil
import subprocess
import unittest

import small_run

ALLOWED = small_run.source / "tests" / "spelling.txt"
PAGES = ("*.md", "docs/**/*.md", "pipelines/goals.tsv", "pipelines/settings.tsv", "pipelines/advice.tsv", "python/breast/page/words.tsv",
         "python/breast/page/templates/*.jinja", "python/breast/study/templates/*.jinja")
# docs/tools holds the help of every program, word by word (tests/tools/docs-current.sh).
_NOT_WORDS = (
    r"(?ms)^(```+).*?^\1", r"(?s)<!--.*?-->", r"(?m)^( {4}|\t).*$",  # code and comments
    r"(?s)(``.+?``|`[^`]+`)", r"\]\([^)]*\)", r"\bhttps?://\S+",  # code in a line, addresses
    r"(?s)\{[{%#].*?[}%#]\}", r"(?s)<[a-z/!][^>]*>", r"&[a-z#0-9]+;", r"(?s)(?<=<style>).*?(?=</style>)",  # markup
    r"(?s)\"[^\"]{30,120}\"",  # titles of papers, spelt as their authors do
    r"\S*[\w][/_=.\\:][\w]\S*", r"(?<!\w)--?[a-z][-a-z]*", r"\S*\d\S*",  # names of files, options, settings
    r"\b\w*[A-Z]\w*[A-Z]\w*\b", r"\b\w+[a-z][A-Z]\w*\b",  # acronyms and names such as ParaView
    r"(?<=\w)['’]s\b")


def prose(text):
    """What is to be spelt: the text without code, markup and names."""
    for pattern in _NOT_WORDS:
        text = re.sub(pattern, " ", text)
    return text


def strange(words):
    """The words that aspell does not know, in their order."""
    return subprocess.run(["aspell", "list", "--lang=en_GB-ise", "--encoding=utf-8", "--ignore=2"], input=words, capture_output=True,
                          text=True, check=True).stdout.split()


def unknown(text):
    """The words of a text that neither aspell nor the list knows."""
    allowed = set(ALLOWED.read_text().split())
    return sorted(set(strange(prose(text))) - allowed - {word.capitalize() for word in allowed})


@unittest.skipUnless(shutil.which("aspell"), "no aspell: apt-get install aspell aspell-en")
class Spelling(unittest.TestCase):
    def test_pages_and_help(self):
        files = sorted({file for pattern in PAGES for file in small_run.source.glob(pattern)})
        self.assertGreater(len(files), 60)
        # All at once: aspell takes as long to start as to read.
        wrong = set(unknown("\n\n".join(prose(file.read_text()) for file in files)))
        where = {word: [file.name for file in files if re.search(rf"\b{re.escape(word)}\b", prose(file.read_text()))] for word in wrong}
        self.assertEqual(where, {}, "mend the word, or add a term of the field to tests/spelling.txt")

    def test_mistakes_are_found_in_words_and_not_in_code(self):
        self.assertEqual(unknown("The tumor of a breest, `tumr`.\n\n    meshx --tumr\n\n```\nbrest\n```\nIts [colour](coulor.md)."),
                         ["breest", "tumor"])

    def test_the_list_is_sorted_and_needed(self):
        words = ALLOWED.read_text().split()
        self.assertEqual(words, sorted(set(words)))
        self.assertEqual(strange("\n".join(words)), words, "aspell knows the others itself")


if __name__ == "__main__":
    unittest.main()
