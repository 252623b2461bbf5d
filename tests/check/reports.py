#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads the reports of one run of mxgen check in all formats and compares their contents. Arguments: JSON, SARIF, JUnit, HTML."""
import html.parser
import json
import pathlib
import sys
import urllib.parse
import xml.etree.ElementTree

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish

with open(sys.argv[1], encoding="utf-8") as file:
    report = json.load(file)
documents = report["documents"]
messages = [message for document in documents for message in document["messages"]]
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
    results = run["results"]
    check({result["ruleId"] for result in results} == set(rules), "SARIF: a rule for each id")
    check([result["message"]["text"] for result in results] == [message["message"] for message in messages], "SARIF: texts")
    check([result["level"] for result in results] == [message["severity"] for message in messages], "SARIF: levels")
    for result, message in zip(results, messages):
        place = result["locations"][0]["physicalLocation"]
        check(urllib.parse.unquote(place["artifactLocation"]["uri"]) == message["file"], "SARIF: the file")
        check(" " not in place["artifactLocation"]["uri"], "SARIF: spaces are escaped")
        check(place.get("region", {}).get("startLine") == message.get("line"), "SARIF: the line")
        check(place.get("region", {}).get("startColumn") == message.get("column"), "SARIF: the column")


def check_junit(path):
    root = xml.etree.ElementTree.parse(path).getroot()
    check(root.tag == "testsuites", "JUnit: root")
    suites = root.findall("testsuite")
    check([suite.get("name") for suite in suites] == [document["file"] for document in documents], "JUnit: a suite for each document")
    for suite, document in zip(suites, documents):
        cases = suite.findall("testcase")
        shaders = [shader for element in document["elements"] for shader in element["shaders"]]
        check(len(cases) == int(suite.get("tests")) == 1 + len(shaders), "JUnit: cases")
        check(len(suite.findall("testcase/failure")) == int(suite.get("failures")), "JUnit: failures")
        check((int(suite.get("failures")) > 0) == (document["status"] == "failed"), f"JUnit: {document['file']} fails where it does")
    texts = [failure.text or "" for failure in root.iter("failure")]
    for message in messages:
        check(message["severity"] != "error" or any(message["rendered"] in text for text in texts), "JUnit: errors are told")


class Page(html.parser.HTMLParser):
    """Cards with their classes and text, and what is loaded."""

    def __init__(self):
        super().__init__()
        self.cards, self.links, self.inside = [], [], False

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.links += [attributes[name] for name in ("src", "href") if name in attributes]
        if tag == "article":
            self.cards.append((attributes, []))
            self.inside = True

    def handle_endtag(self, tag):
        if tag == "article":
            self.inside = False

    def handle_data(self, data):
        if self.inside:
            self.cards[-1][1].append(data)


def check_html(path):
    xml.etree.ElementTree.parse(path)
    page = Page()
    with open(path, encoding="utf-8") as file:
        page.feed(file.read())
    check(not [link for link in page.links if not link.startswith("data:")], "HTML: nothing is loaded")
    empty = sum(not document["elements"] for document in documents)
    check(len(page.cards) == len(elements) + empty, "HTML: a card for each element")
    text = "\n".join("".join(parts) for _, parts in page.cards)
    for message in messages:
        check(message["rendered"] in text, "HTML: messages with their lines")
    for document, element in elements:
        card = [(attributes, "".join(parts)) for attributes, parts in page.cards
                if element["path"] in "".join(parts) and document["file"] in "".join(parts)]
        check(len(card) == 1, f"HTML: {element['path']}")
        sizes = [shader.get("sourceBytes", 0) for shader in element["shaders"]]
        check(all(str(size) in card[0][1] for size in sizes), "HTML: sizes")
        check(card[0][0]["data-source-bytes"] == str(max(sizes)), "HTML: what is sorted by")


check_sarif(sys.argv[2])
check_junit(sys.argv[3])
check_html(sys.argv[4])
finish("check-reports")
