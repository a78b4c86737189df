"""Reads GRAPHML with networkx and holds each graph against an out-tree in JSON (from `ramify grow`).

usage: graphml_check.py GRAPHML NAME=JSON...

The graphs must have these names, in this order; each must be a forest of the JSON's nodes with edges from parents to
children, the same numbers to the last bit, and lengths that are the distances. Exits 1 after telling what differs.
"""
import json
import math
import sys
import xml.etree.ElementTree as ElementTree

import networkx
import numpy

SPACE = "{http://graphml.graphdrawing.org/xmlns}"


def check_structure(root):
    """What the schema asks for: keys first, each declared once and used where it is for, names that are unique."""
    tags = [child.tag for child in root]
    assert root.tag == SPACE + "graphml"
    assert tags == sorted(tags, key=[SPACE + "key", SPACE + "graph"].index), "keys must come before graphs"
    keys = {key.get("id"): key.get("for") for key in root.findall(SPACE + "key")}
    assert len(keys) == tags.count(SPACE + "key")
    names = set()
    for graph in root.findall(SPACE + "graph"):
        assert graph.get("edgedefault") == "directed"
        for element in [graph, *graph.findall(SPACE + "node"), *graph.findall(SPACE + "edge")]:
            if element.tag != SPACE + "edge":
                assert element.get("id") not in names, "a name is taken twice"
                names.add(element.get("id"))
            for data in element.findall(SPACE + "data"):
                assert keys[data.get("key")] == element.tag[len(SPACE):], "data of a key for something else"


def single(value):
    return numpy.float32(value)


def check_graph(graph, tree):
    parents = tree["parent"]
    assert graph.is_directed() and networkx.is_forest(graph)
    assert graph.number_of_nodes() == tree["count"]
    assert graph.number_of_edges() == sum(parent >= 0 for parent in parents)
    nodes = list(graph.nodes(data=True))
    for i, (node, data) in enumerate(nodes):
        assert [single(data[axis]) for axis in "xyz"] == [single(x) for x in tree["position"][i]]
        assert single(data["radius"]) == single(tree["radius"][i])
        assert (data["birth"], data["colony"], data["key"]) == (tree["birth"][i], tree["colony"][i], tree["id"][i])
        above = list(graph.predecessors(node))
        assert above == ([nodes[parents[i]][0]] if parents[i] >= 0 else [])
        if above:
            length = graph.edges[above[0], node]["length"]
            assert math.isclose(length, math.dist(tree["position"][i], tree["position"][parents[i]]), rel_tol=1e-5,
                                abs_tol=1e-6)


def main():
    root = ElementTree.parse(sys.argv[1]).getroot()
    check_structure(root)
    names = [graph.find(SPACE + "data").text for graph in root.findall(SPACE + "graph")]
    wanted = [argument.rpartition("=") for argument in sys.argv[2:]]
    assert names == [name for name, _, _ in wanted], names
    graphs = list(networkx.readwrite.graphml.GraphMLReader()(path=sys.argv[1]))
    assert len(graphs) == len(wanted)
    for graph, (_, _, file) in zip(graphs, wanted):
        with open(file, encoding="utf-8") as stream:
            check_graph(graph, json.load(stream))


main()
