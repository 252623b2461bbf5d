// SPDX-License-Identifier: Apache-2.0
/* bench-parse FILE: the minimum cost of a program that links libxml2 and parses the file. */
#include <libxml/parser.h>

int main(int argc, char **argv)
{
    xmlSAXHandler nothing = {.initialized = XML_SAX2_MAGIC};
    return argc == 2 && xmlSAXUserParseFile(&nothing, NULL, argv[1]) == 0 ? 0 : 1;
}
