#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads the reports of one run of mxgen check in all formats and compares their contents. Arguments: JSON, SARIF, JUnit, HTML,
messages.md."""
import html.parser
import json
import pathlib
import re
import sys
import urllib.parse
import xml.etree.ElementTree

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish

EXPLANATIONS = pathlib.Path(sys.argv[5]).read_text(encoding="utf-8")
OWN_FAILURES = ("load", "validate", "render", "crash", "timeout")
REASONS = ("cannot be loaded", "does not match the node library", "cannot generate the shader", "rejects the shader", "cannot be rendered",
           "exceeds its budget", "worker crashed", "takes too long")
with open(sys.argv[1], encoding="utf-8") as file:
    report = json.load(file)
gone = report.get("gone", [])
documents = report["documents"]
messages = [message for document in documents for message in document["messages"]]
# SARIF also has those of the baseline that are gone.
results_of = [(document, message) for document in documents for message in document["messages"] + document.get("goneMessages", [])]
results_of += [(document, message) for document in gone for message in document["messages"]]
elements = [(document, element) for document in documents for element in document["elements"]]


def check_sarif(path):
    """SARIF 2.1.0: what sections 3.13, 3.14, 3.18, 3.19 and 3.27 require, and that it tells the same as the JSON."""
    with open(path, encoding="utf-8") as file:
        log = json.load(file)
    check(log["version"] == "2.1.0", "SARIF: version")
    run, = log["runs"]
    driver = run["tool"]["driver"]
    check(driver["name"] == "mxgen", "SARIF: name of the tool")
    rules = [rule["id"] for rule in driver["rules"]]
    check(len(rules) == len(set(rules)), "SARIF: rules are unique")
    check(all(rule["help"]["text"] for rule in driver["rules"]), "SARIF: rules say what to do")
    for rule in driver["rules"]:
        address = urllib.parse.urlsplit(rule["helpUri"])
        check(address.scheme and address.fragment == rule["id"], "SARIF: rules link to their explanation")
        check(f"\n## {rule['id']}\n" in EXPLANATIONS, f"SARIF: the explanation of {rule['id']}")
    results = run["results"]
    check({result["ruleId"] for result in results} == set(rules), "SARIF: a rule for each id")
    check([result["message"]["text"] for result in results] == [message["message"] for _, message in results_of], "SARIF: texts")
    check([result["level"] for result in results] == [message["severity"] for _, message in results_of], "SARIF: levels")
    prints = [(document.get("name"), *result["partialFingerprints"].values()) for result, (document, _) in zip(results, results_of)]
    check(len(set(prints)) == len(prints), "SARIF: fingerprints differ in a document")
    for result, (_, message) in zip(results, results_of):
        check(result.get("baselineState") == message.get("baselineState"), "SARIF: the state since the baseline")
        check(("baselineState" in result) == ("compared" in report), "SARIF: the state is of a comparison")
        related = result.get("relatedLocations", [])
        check([note["message"]["text"] for note in related] == [note["message"] for note in message.get("notes", [])], "SARIF: notes")
        for place, note in zip(related, message.get("notes", [])):
            region = place.get("physicalLocation", {}).get("region", {})
            check(region.get("startLine") == note.get("line"), "SARIF: places of notes")
        place = result["locations"][0]["physicalLocation"]
        check(urllib.parse.unquote(place["artifactLocation"]["uri"]) == message["file"], "SARIF: the file")
        check(" " not in place["artifactLocation"]["uri"], "SARIF: spaces are escaped")
        check(place.get("region", {}).get("startLine") == message.get("line"), "SARIF: the line")
        check(place.get("region", {}).get("startColumn") == message.get("column"), "SARIF: the column")
        if "column" in message:
            check(place["region"]["endColumn"] == message["column"] + message.get("length", 1), "SARIF: the end column")


def check_junit(path):
    root = xml.etree.ElementTree.parse(path).getroot()
    check(root.tag == "testsuites", "JUnit: root")
    suites = root.findall("testsuite")
    check([suite.get("name") for suite in suites] == [document["file"] for document in documents + gone], "JUnit: a suite for each document")
    for suite, document in zip(suites, documents + gone):
        cases = suite.findall("testcase")
        shaders = [] if document in gone else [(element, shader) for element in document["elements"] for shader in element["shaders"]]
        check(len(cases) == int(suite.get("tests")) == 1 + len(shaders), "JUnit: cases")
        check(len(suite.findall("testcase/failure")) == int(suite.get("failures")), "JUnit: failures")
        check(len(suite.findall("testcase/skipped")) == int(suite.get("skipped")), "JUnit: skipped cases")
        for case, (element, shader) in zip(cases, [(None, None)] + shaders):
            is_now = "failed" if case.find("failure") is not None else "skipped" if case.find("skipped") is not None else "passed"
            expected = outcome(document, element, shader)
            check(is_now == expected, f"JUnit: {document['file']} {case.get('name')} is {is_now}, not {expected}")
    for total in "tests", "failures", "skipped":
        check(int(root.get(total)) == sum(int(suite.get(total)) for suite in suites), f"JUnit: the sum of {total}")
    texts = [failure.text or "" for failure in root.iter("failure")]
    for message in messages:
        is_due = message["severity"] == "error" and message.get("baselineState") != "unchanged"
        check(not is_due or any(message["rendered"] in text for text in texts), "JUnit: errors are told")


def outcome(document, element, shader):
    """Of a case of JUnit: with a baseline its changes count, and known failures are skipped."""
    if "compared" not in report:
        errors = shader["status"] if shader else "failed" if document.get("failure") in OWN_FAILURES else "passed"
        return errors
    mine = [change for change in document.get("changes", [])
            if (shader and (change.get("element"), change.get("target")) == (element["path"], shader["target"]))
            or (not shader and not (change.get("element") and change.get("target")))]
    if any(change["kind"] in ("fails", "new-errors", "uncompiled") for change in mine):
        return "failed"
    failed = shader["status"] == "failed" if shader else document.get("failure") in OWN_FAILURES
    return "skipped" if failed or document in gone else "passed"


class Page(html.parser.HTMLParser):
    """Cards with their classes and text, and what is loaded."""

    def __init__(self):
        super().__init__()
        self.cards, self.links, self.inside, self.totals, self.in_totals = [], [], False, "", False

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.links += [attributes[name] for name in ("src", "href") if name in attributes]
        self.in_totals = self.in_totals or tag == "section"
        if tag == "article":
            self.cards.append((attributes, []))
            self.inside = True

    def handle_endtag(self, tag):
        if tag == "article":
            self.inside = False
        self.in_totals = self.in_totals and tag != "section"

    def handle_data(self, data):
        if self.in_totals:
            self.totals += data
        if self.inside:
            self.cards[-1][1].append(data)


def has_card(document):
    """A document without elements, and one of many that has a message or a change of its own."""
    paths = [element["path"] for element in document["elements"]]
    parts = document["messages"] + document.get("changes", [])
    return not paths or len(paths) > 1 and any(part.get("element", "") not in paths for part in parts)


def check_html(path):
    xml.etree.ElementTree.parse(path)
    page = Page()
    with open(path, encoding="utf-8") as file:
        page.feed(file.read())
    check(not [link for link in page.links if not link.startswith("data:")], "HTML: nothing is loaded")
    of_documents = sum(has_card(document) for document in documents)
    check(len(page.cards) == len(elements) + of_documents + len(gone), "HTML: a card for each element, and for what is of the document alone")
    check(sum("gone" in attributes["class"].split() for attributes, _ in page.cards) == len(gone), "HTML: cards for what is gone")
    text = "\n".join("".join(parts) for _, parts in page.cards)
    for message in messages:
        check(all(line in text for line in message["rendered"].split("\n")), "HTML: messages with their lines")
    ranks = ["fails" not in attributes["class"].split() for attributes, _ in page.cards]
    check(ranks == sorted(ranks), "HTML: failures are first")
    for attributes, parts in page.cards:
        words = any(word in "".join(parts) for word in REASONS)
        check(words == ("failed" in attributes["class"].split()), f"HTML: a failure in words: {''.join(parts)[:40]}")
    totals = page.totals
    check(re.search(r"\d{4}-\d\d-\d\d \d\d:\d\d UTC", totals), "HTML: the date")
    check(all(target in totals for target in report["targets"]), "HTML: the targets")
    for count, what in (len(documents), "documents"), (report["summary"]["failed"], "failed"), (report["summary"].get("warnings", 0), "warnings"):
        check(f"{count} {what}" in totals, f"HTML: the total {count} {what}")
    for document, element in elements:
        card = [(attributes, "".join(parts)) for attributes, parts in page.cards
                if element["path"] in "".join(parts) and document["file"] in "".join(parts)]
        check(len(card) == 1, f"HTML: {element['path']}")
        sizes = [shader.get("sourceBytes", 0) for shader in element["shaders"]]
        check(all(str(size or "") in card[0][1] for size in sizes), "HTML: sizes")
        check(card[0][0]["data-source-bytes"] == str(max(sizes)), "HTML: what is sorted by")


check_sarif(sys.argv[2])
check_junit(sys.argv[3])
check_html(sys.argv[4])
finish("check-reports")
