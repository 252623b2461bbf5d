// SPDX-License-Identifier: Apache-2.0
#include "cli/node_list.h"

#include "program/args.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c | 0x20) : c;
}

static bool contains(const char *text, const char *word)
{
    for (; *text; ++text) {
        size_t i = 0;
        while (word[i] && lower(text[i]) == lower(word[i]))
            ++i;
        if (!word[i])
            return true;
    }
    return false;
}

static mxg_nodedef get_nodedef(const mxg_library *library, uint32_t index)
{
    mxg_nodedef nodedef = {sizeof nodedef};
    mxg_library_nodedef(library, index, &nodedef);
    return nodedef;
}

static void print_ports(const mxg_library *library, uint32_t nodedef, uint32_t first, uint32_t num)
{
    for (uint32_t i = 0; i < num; ++i) {
        mxg_port port = {sizeof port};
        if (mxg_library_port(library, nodedef, first + i, &port) == MXG_OK)
            printf("%s%s:%s", i ? ", " : "", port.name, port.type);
    }
}

static void print_line(const mxg_library *library, uint32_t index, const mxg_nodedef *nodedef)
{
    printf("%s  %s(", nodedef->name, nodedef->node);
    print_ports(library, index, 0, nodedef->num_inputs);
    fputs(") -> ", stdout);
    print_ports(library, index, nodedef->num_inputs, nodedef->num_outputs);
    puts(nodedef->has_implementation ? "" : "  (no implementation)");
}

uint32_t nodes_list(const mxg_library *library, const char *const *words, size_t num_words)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < mxg_library_num_nodedefs(library); ++i) {
        mxg_nodedef nodedef = get_nodedef(library, i);
        bool is_listed = num_words == 0;
        for (size_t w = 0; w < num_words; ++w)
            is_listed |= contains(nodedef.name, words[w]) || contains(nodedef.node, words[w]);
        if (is_listed)
            print_line(library, i, &nodedef);
        count += is_listed;
    }
    return count;
}

/* A line per input: name, type, default. */
static void print_inputs(const mxg_library *library, uint32_t index, const mxg_nodedef *nodedef)
{
    for (uint32_t i = 0; i < nodedef->num_inputs; ++i) {
        mxg_port port = {sizeof port};
        if (mxg_library_port(library, index, i, &port) != MXG_OK)
            continue;
        printf("    %-28s %-14s %s%s\n", port.name, port.type, port.value, port.defaultgeomprop);
        if (*port.enum_names)
            printf("    %-28s %-14s one of: %s\n", "", "", port.enum_names);
    }
}

enum { MAX_DETAILED = 2 }; /* definitions of a node, for which the inputs appear in lines */

bool nodes_explain(const mxg_library *library, const char *name)
{
    uint32_t count = 0, num_nodedefs = mxg_library_num_nodedefs(library);
    for (uint32_t i = 0; i < num_nodedefs; ++i) {
        mxg_nodedef nodedef = get_nodedef(library, i);
        count += strcmp(nodedef.node, name) == 0 || strcmp(nodedef.name, name) == 0;
    }
    for (uint32_t i = 0, told = 0; told < count && i < num_nodedefs; ++i) {
        mxg_nodedef nodedef = get_nodedef(library, i);
        if (strcmp(nodedef.node, name) != 0 && strcmp(nodedef.name, name) != 0)
            continue;
        if (told++ == 0)
            printf("node <%s>%s%s\n", nodedef.node, *nodedef.doc ? ": " : "", nodedef.doc);
        fputs("  ", stdout);
        if (count > MAX_DETAILED) {
            print_line(library, i, &nodedef);
            continue;
        }
        printf("%s%s%s -> ", nodedef.name, *nodedef.version ? ", version " : "", nodedef.version);
        print_ports(library, i, nodedef.num_inputs, nodedef.num_outputs);
        putchar('\n');
        print_inputs(library, i, &nodedef);
    }
    return count != 0;
}

const char *nodes_closest(const mxg_library *library, const char *word)
{
    struct arg_list names = {0};
    for (uint32_t i = 0; i < mxg_library_num_nodedefs(library); ++i) {
        mxg_nodedef nodedef = get_nodedef(library, i);
        args_append(&names, nodedef.node);
        args_append(&names, nodedef.name);
    }
    const char *near = args_closest(word, names.items, names.len);
    free(names.items);
    return near;
}
