// SPDX-License-Identifier: Apache-2.0
/* Documents of earlier versions, and what they become. */
#include "document_fixture.h"

/* What a document of a version becomes. */
static void require_upgrade(const char *version, const char *content, const char *expected)
{
    struct fixture f;
    fixture_init(&f);
    struct text text;
    text_init(&text, &f.arena);
    text_fmt(&text, "<materialx version=\"%s\">%s</materialx>", version, content);
    fixture_read_bytes(&f, text.data, text.len, NULL);
    if (!REQUIRE_STR(fixture_tree(&f), expected))
        printf("    from %s\n", content);
    REQUIRE_STR(str_text(&f.strings, doc_attr_value(&f.doc, f.doc.root, STR_version)), "1.39");
    fixture_close(&f);
}

static void test_renames(void)
{
    require_upgrade("1.22",
                    "<constant name=\"a\" type=\"vector\"><parameter name=\"color\" "
                    "type=\"vector\" value=\"1,1,1\"/></constant>",
                    "<constant name=\"a\" type=\"vector3\">\n  <input name=\"value\" "
                    "type=\"vector3\" value=\"1,1,1\"/>\n</constant>\n");
    require_upgrade(
        "1.34",
        "<a name=\"n\" type=\"matrix\"/><look name=\"l\"><materialassign name=\"m\"/></look>",
        "<a name=\"n\" type=\"matrix44\"/>\n<look name=\"l\">\n  <materialassign name=\"m\" "
        "material=\"m\"/>\n</look>\n");
    require_upgrade("1.35",
                    "<image name=\"i\"><parameter name=\"file\" type=\"filename\" "
                    "value=\"a%UDIM.b%UVTILE\"/></image>"
                    "<look name=\"a\"><lookinherit name=\"x\" look=\"b\"/></look>",
                    "<image name=\"i\">\n  <input name=\"file\" type=\"filename\" "
                    "value=\"a&lt;UDIM&gt;.b&lt;UVTILE&gt;\"/>\n</image>\n"
                    "<look name=\"a\" inherit=\"b\"/>\n");
    require_upgrade("1.36",
                    "<invert name=\"i\" type=\"matrix33\"/><rotate name=\"r\" "
                    "type=\"vector2\"/><rotate name=\"s\" type=\"vector3\"/>",
                    "<invertmatrix name=\"i\" type=\"matrix33\"/>\n<rotate2d name=\"r\" "
                    "type=\"vector2\"/>\n<rotate3d name=\"s\" type=\"vector3\"/>\n");
    require_upgrade("1.36",
                    "<compare name=\"c\" type=\"float\"><input name=\"intest\"/><parameter "
                    "name=\"cutoff\"/><input name=\"in1\"/>"
                    "<input name=\"in2\"/></compare>",
                    "<ifgreatereq name=\"c\" type=\"float\">\n  <input name=\"value1\"/>\n  <input "
                    "name=\"value2\"/>\n  <input name=\"in2\"/>\n"
                    "  <input name=\"in1\"/>\n</ifgreatereq>\n");
    require_upgrade("1.36",
                    "<combine name=\"c\"><input name=\"in3\"/></combine><separate "
                    "name=\"s\"><input name=\"in\" type=\"color4\"/></separate>",
                    "<combine3 name=\"c\">\n  <input name=\"in3\"/>\n</combine3>\n<separate4 "
                    "name=\"s\">\n  <input name=\"in\" type=\"color4\"/>\n</separate4>\n");
    require_upgrade(
        "1.37", "<atan2 name=\"a\"><input name=\"in1\"/><input name=\"in2\"/></atan2>",
        "<atan2 name=\"a\">\n  <input name=\"inx\"/>\n  <input name=\"iny\"/>\n</atan2>\n");
    require_upgrade("1.38", "<atan2 name=\"a\"><input name=\"in1\"/></atan2>",
                    "<atan2 name=\"a\">\n  <input name=\"iny\"/>\n</atan2>\n");
    require_upgrade("1.36",
                    "<geominfo name=\"g\"><geomattr name=\"a\"/></geominfo><geomattrvalue "
                    "name=\"v\" attrname=\"a\"/>",
                    "<geominfo name=\"g\">\n  <geomprop name=\"a\"/>\n</geominfo>\n<geompropvalue "
                    "name=\"v\" geomprop=\"a\"/>\n");
}

/* What documents of the current version contain, too. */
static void test_always(void)
{
    require_upgrade("1.39",
                    "<input name=\"a\" type=\"boolean\" value=\"True\" uniform=\"False\"/>"
                    "<input name=\"b\" type=\"string\" value=\"True\"/>",
                    "<input name=\"a\" type=\"boolean\" value=\"true\" uniform=\"false\"/>\n"
                    "<input name=\"b\" type=\"string\" value=\"True\"/>\n");
    require_upgrade("1.37", "<input name=\"a\" type=\"boolean\" value=\"FALSE\"/>",
                    "<input name=\"a\" type=\"boolean\" value=\"false\"/>\n");
    require_upgrade("1.39",
                    "<geompropvalue name=\"a\" type=\"string\"/><geompropvalue name=\"b\" "
                    "type=\"filename\"/><geompropvalue name=\"c\" type=\"float\"/>",
                    "<geompropvalueuniform name=\"a\" type=\"string\"/>\n<geompropvalueuniform "
                    "name=\"b\" type=\"filename\"/>\n<geompropvalue name=\"c\" type=\"float\"/>\n");
    require_upgrade("1.39",
                    "<nodedef name=\"N\" node=\"geompropvalue\"><output name=\"out\" "
                    "type=\"string\"/></nodedef>",
                    "<nodedef name=\"N\" node=\"geompropvalueuniform\">\n  <output name=\"out\" "
                    "type=\"string\"/>\n</nodedef>\n");
    require_upgrade("1.38",
                    "<nodedef name=\"N\" node=\"subsurface_bsdf\"><input name=\"radius\" "
                    "type=\"vector3\" value=\"1, 1, 1\"/></nodedef>",
                    "<nodedef name=\"N\" node=\"subsurface_bsdf\">\n  <input name=\"radius\" "
                    "type=\"color3\" value=\"1, 1, 1\"/>\n</nodedef>\n");
    require_upgrade("1.39",
                    "<constant name=\"a\" type=\"color2\"><input name=\"value\" "
                    "type=\"color2\" value=\"0, 1\"/></constant><separate2 name=\"s\" "
                    "type=\"multioutput\"><input name=\"in\" type=\"color2\" "
                    "nodename=\"a\"/></separate2><dot name=\"d\" type=\"float\"><input name=\"in\" "
                    "type=\"float\" nodename=\"s\" output=\"outa\"/></dot>",
                    "<constant name=\"a\" type=\"vector2\">\n  <input name=\"value\" "
                    "type=\"vector2\" value=\"0, 1\"/>\n</constant>\n<separate2 name=\"s\" "
                    "type=\"multioutput\">\n  <input name=\"in\" type=\"vector2\" "
                    "nodename=\"a\"/>\n</separate2>\n<dot name=\"d\" type=\"float\">\n  <input "
                    "name=\"in\" type=\"float\" nodename=\"s\" output=\"outy\"/>\n</dot>\n");
}

static void test_structure(void)
{
    require_upgrade(
        "1.36",
        "<nodedef name=\"N\" node=\"n\" type=\"float\" defaultinput=\"i\"><parameter name=\"i\" "
        "type=\"float\"/></nodedef>",
        "<nodedef name=\"N\" node=\"n\">\n  <input name=\"i\" type=\"float\" uniform=\"true\"/>\n"
        "  <output name=\"out\" type=\"float\" defaultinput=\"i\"/>\n</nodedef>\n");
    require_upgrade("1.36",
                    "<nodegraph name=\"g\"><backdrop name=\"b\"><parameter name=\"note\" "
                    "value=\"x\"/></backdrop></nodegraph>",
                    "<nodegraph name=\"g\">\n  <backdrop name=\"b\" note=\"x\"/>\n</nodegraph>\n");
    require_upgrade(
        "1.37",
        "<nodegraph name=\"g\" version=\"1.0\"><add name=\"a\"><input name=\"in1\" "
        "interfacename=\"b\"/></add>"
        "<add name=\"b\"/><output name=\"o\" nodename=\"b\"/></nodegraph>",
        "<nodegraph name=\"g\">\n  <add name=\"a\">\n    <input name=\"in1\" "
        "interfacename=\"b\"/>\n  </add>\n"
        "  <add name=\"b_node\"/>\n  <output name=\"o\" nodename=\"b_node\"/>\n</nodegraph>\n");
    require_upgrade("1.38",
                    "<add name=\"a\"><input name=\"in1\" value=\"1\" nodename=\"a\"/></add>",
                    "<add name=\"a\">\n  <input name=\"in1\" nodename=\"a\"/>\n</add>\n");
    require_upgrade(
        "1.38", "<switch name=\"s\"><input name=\"which\" type=\"integer\" value=\"7\"/></switch>",
        "<switch name=\"s\">\n  <input name=\"which\" type=\"integer\" value=\"0\"/>\n</switch>\n");
}

static void test_materials(void)
{
    require_upgrade(
        "1.37",
        "<material name=\"M\" doc=\"d\"><shaderref name=\"S\" node=\"standard_surface\"><bindinput "
        "name=\"base\" type=\"float\" value=\"1\"/>"
        "<bindtoken name=\"t\"/></shaderref></material><material name=\"N\" "
        "inherit=\"M\"/><standard_surface name=\"S\"/>",
        "<standard_surface name=\"S2\" type=\"surfaceshader\">\n  <input name=\"base\" "
        "type=\"float\" value=\"1\"/>\n"
        "  <token name=\"t\"/>\n</standard_surface>\n"
        "<surfacematerial name=\"M\" doc=\"d\" type=\"material\">\n"
        "  <input name=\"surfaceshader\" type=\"surfaceshader\" "
        "nodename=\"S2\"/>\n</surfacematerial>\n"
        "<surfacematerial name=\"N\" type=\"material\">\n"
        "  <input name=\"surfaceshader\" type=\"surfaceshader\" "
        "nodename=\"S2\"/>\n</surfacematerial>\n"
        "<standard_surface name=\"S\"/>\n");
    require_upgrade(
        "1.37",
        "<nodedef name=\"ND_v\" node=\"v\"><output name=\"out\" type=\"volumeshader\"/></nodedef>"
        "<material name=\"M\"><shaderref name=\"S\" nodedef=\"ND_v\"/></material>",
        "<nodedef name=\"ND_v\" node=\"v\">\n  <output name=\"out\" "
        "type=\"volumeshader\"/>\n</nodedef>\n"
        "<v name=\"S\" nodedef=\"ND_v\" type=\"volumeshader\"/>\n"
        "<volumematerial name=\"M\" type=\"material\">\n  <input name=\"volumeshader\" "
        "type=\"volumeshader\" nodename=\"S\"/>\n</volumematerial>\n");
    require_upgrade("1.25",
                    "<opgraph name=\"g\"><add name=\"a\" type=\"float\"><parameter name=\"in1\" "
                    "type=\"opgraphnode\" value=\"c\"/></add>"
                    "<constant name=\"c\" type=\"float\"><parameter name=\"color\" type=\"float\" "
                    "value=\"1\"/></constant>"
                    "<output name=\"o\" type=\"float\"><parameter name=\"in\" type=\"opgraphnode\" "
                    "value=\"a\"/></output></opgraph>"
                    "<shader name=\"S\" shadertype=\"surface\" shaderprogram=\"p\">"
                    "<input name=\"x\" type=\"float\" opgraph=\"g\" graphoutput=\"o\"/><input "
                    "name=\"y\" type=\"float\" publicname=\"py\"/></shader>"
                    "<material name=\"M\"><shaderref name=\"S\" shadertype=\"surface\"/><override "
                    "name=\"py\" value=\"2\"/></material>",
                    "<nodegraph name=\"g\">\n  <add name=\"a\" type=\"float\">\n    <input "
                    "name=\"in1\" type=\"float\" nodename=\"c\"/>\n  </add>\n"
                    "  <constant name=\"c\" type=\"float\">\n    <input name=\"value\" "
                    "type=\"float\" value=\"1\"/>\n  </constant>\n"
                    "  <output name=\"o\" type=\"float\" nodename=\"a\"/>\n</nodegraph>\n"
                    "<p name=\"S\" type=\"surfaceshader\">\n  <input name=\"x\" type=\"float\" "
                    "nodegraph=\"g\" output=\"o\"/>\n"
                    "  <input name=\"y\" type=\"float\" value=\"2\"/>\n</p>\n"
                    "<surfacematerial name=\"M\" type=\"material\">\n  <input "
                    "name=\"surfaceshader\" type=\"surfaceshader\" nodename=\"S\"/>\n"
                    "</surfacematerial>\n");
}

static void test_closures(void)
{
    require_upgrade("1.37",
                    "<dielectric_brdf name=\"a\" type=\"BSDF\"><input name=\"base\" type=\"BSDF\" "
                    "nodename=\"b\"/></dielectric_brdf>"
                    "<dielectric_btdf name=\"b\" type=\"BSDF\"><input name=\"interior\" "
                    "nodename=\"v\"/></dielectric_btdf>",
                    "<dielectric_bsdf name=\"a_top\" type=\"BSDF\"/>\n"
                    "<layer name=\"a\" type=\"BSDF\">\n  <input name=\"top\" type=\"BSDF\" "
                    "nodename=\"a_top\"/>\n"
                    "  <input name=\"base\" type=\"BSDF\" nodename=\"b\"/>\n</layer>\n"
                    "<dielectric_bsdf name=\"b\" type=\"BSDF\">\n  <input name=\"scatter_mode\" "
                    "type=\"string\" value=\"T\"/>\n</dielectric_bsdf>\n");
    /* the name of a shader must be one of an element */
    require_upgrade("1.37", "<material name=\"M\"><shaderref name=\"S\" node=\"10\"/></material>",
                    "<surfacematerial name=\"M\" type=\"material\"/>\n");
    require_upgrade("1.37",
                    "<conductor_brdf name=\"a\" type=\"BSDF\"><input name=\"reflectivity\" "
                    "type=\"color3\" value=\"1,1,1\"/></conductor_brdf>",
                    "<artistic_ior name=\"artistic_ior\" type=\"multioutput\">\n  <input "
                    "name=\"reflectivity\" type=\"color3\" value=\"1,1,1\"/>\n"
                    "  <output name=\"ior\" type=\"color3\"/>\n  <output name=\"extinction\" "
                    "type=\"color3\"/>\n</artistic_ior>\n"
                    "<conductor_bsdf name=\"a\" type=\"BSDF\">\n  <input name=\"ior\" "
                    "type=\"color3\" nodename=\"artistic_ior\" output=\"ior\"/>\n"
                    "  <input name=\"extinction\" type=\"color3\" nodename=\"artistic_ior\" "
                    "output=\"extinction\"/>\n</conductor_bsdf>\n");
    /* the index of a metal comes back, and a connected one is converted */
    require_upgrade("1.37",
                    "<normal name=\"n\" type=\"vector3\"/><complex_ior name=\"c\" "
                    "type=\"multioutput\"><input name=\"extinction\" type=\"vector3\" "
                    "nodename=\"n\"/></complex_ior>"
                    "<conductor_brdf name=\"a\" type=\"BSDF\"><input name=\"reflectivity\" "
                    "type=\"color3\" nodename=\"c\" output=\"reflectivity\"/><input "
                    "name=\"edge_color\" type=\"color3\" nodename=\"c\" "
                    "output=\"edge_color\"/></conductor_brdf>",
                    "<normal name=\"n\" type=\"vector3\"/>\n"
                    "<convert name=\"convert\" type=\"color3\">\n  <input name=\"in\" "
                    "type=\"vector3\" nodename=\"n\"/>\n</convert>\n"
                    "<conductor_bsdf name=\"a\" type=\"BSDF\">\n  <input name=\"ior\" "
                    "type=\"color3\" value=\"0.271, 0.677, 1.316\"/>\n"
                    "  <input name=\"extinction\" type=\"color3\" nodename=\"convert\"/>\n"
                    "</conductor_bsdf>\n");
    require_upgrade("1.38",
                    "<complex_ior name=\"c\" type=\"multioutput\"><input name=\"ior\" "
                    "type=\"vector3\" value=\"1,2,3\"/></complex_ior>"
                    "<artistic_ior name=\"a\" type=\"multioutput\"><input "
                    "name=\"reflectivity\" type=\"color3\" nodename=\"c\" "
                    "output=\"reflectivity\"/><input name=\"edge_color\" type=\"color3\" "
                    "nodename=\"c\" output=\"edge_color\"/></artistic_ior>"
                    "<convert name=\"x\" type=\"vector3\"><input name=\"in\" "
                    "type=\"color3\" nodename=\"a\" output=\"ior\"/></convert>",
                    "<convert name=\"x\" type=\"vector3\">\n  <input name=\"in\" "
                    "type=\"color3\" value=\"1,2,3\"/>\n</convert>\n");
    require_upgrade(
        "1.38",
        "<thin_film_bsdf name=\"t\" type=\"BSDF\"><input name=\"thickness\" type=\"float\" "
        "value=\"500\"/></thin_film_bsdf>"
        "<conductor_bsdf name=\"c\" type=\"BSDF\"/>"
        "<layer name=\"l\" type=\"BSDF\"><input name=\"top\" type=\"BSDF\" nodename=\"t\"/><input "
        "name=\"base\" type=\"BSDF\" nodename=\"c\"/></layer>"
        "<surface name=\"s\" type=\"surfaceshader\"><input name=\"bsdf\" type=\"BSDF\" "
        "nodename=\"l\"/></surface>",
        "<conductor_bsdf name=\"c\" type=\"BSDF\">\n  <input name=\"thinfilm_thickness\" "
        "type=\"float\" value=\"500\"/>\n</conductor_bsdf>\n"
        "<surface name=\"s\" type=\"surfaceshader\">\n  <input name=\"bsdf\" type=\"BSDF\" "
        "nodename=\"c\"/>\n</surface>\n");
    require_upgrade("1.38",
                    "<thin_film_bsdf name=\"t\" type=\"BSDF\"/><layer name=\"l\" "
                    "type=\"BSDF\"><input name=\"top\" nodename=\"t\"/>"
                    /* a circle stays one */
                    "<input name=\"base\" nodename=\"l\"/></layer>",
                    "<thin_film_bsdf name=\"t\" type=\"BSDF\"/>\n<layer name=\"l\" "
                    "type=\"BSDF\">\n  <input name=\"top\" nodename=\"t\"/>\n"
                    "  <input name=\"base\" nodename=\"l\"/>\n</layer>\n");
    require_upgrade("1.38",
                    "<subsurface_bsdf name=\"s\" type=\"BSDF\"><input name=\"radius\" "
                    "type=\"vector3\" nodename=\"r\"/></subsurface_bsdf>",
                    "<convert name=\"convert\" type=\"color3\">\n  <input name=\"in\" "
                    "type=\"vector3\" nodename=\"r\"/>\n</convert>\n"
                    "<subsurface_bsdf name=\"s\" type=\"BSDF\">\n  <input name=\"radius\" "
                    "type=\"color3\" nodename=\"convert\"/>\n</subsurface_bsdf>\n");
}

static void test_normalmaps(void)
{
    require_upgrade("1.38",
                    "<normalmap name=\"n\" type=\"vector3\" nodedef=\"ND_normalmap\"><input "
                    "name=\"in\" type=\"vector3\" nodename=\"i\"/>"
                    "<input name=\"space\" type=\"string\" value=\"object\"/></normalmap>",
                    "<multiply name=\"normalmap_multiply\" type=\"vector3\">\n  <input "
                    "name=\"in1\" type=\"vector3\" nodename=\"i\"/>\n"
                    "  <input name=\"in2\" type=\"float\" value=\"2.0\"/>\n</multiply>\n"
                    "<subtract name=\"normalmap_subtract\" type=\"vector3\">\n  <input "
                    "name=\"in1\" type=\"vector3\" nodename=\"normalmap_multiply\"/>\n"
                    "  <input name=\"in2\" type=\"float\" value=\"1.0\"/>\n</subtract>\n"
                    "<normalize name=\"n\" type=\"vector3\">\n  <input name=\"in\" "
                    "type=\"vector3\" nodename=\"normalmap_subtract\"/>\n</normalize>\n");
    require_upgrade(
        "1.38",
        "<normalmap name=\"n\" type=\"vector3\"><input name=\"normal\" type=\"vector3\" "
        "nodename=\"i\"/></normalmap>",
        "<tangent name=\"tangent\" type=\"vector3\">\n  <input name=\"space\" type=\"string\" "
        "value=\"world\"/>\n</tangent>\n"
        "<crossproduct name=\"normalmap_cross\" type=\"vector3\">\n  <input name=\"in1\" "
        "type=\"vector3\" nodename=\"i\"/>\n"
        "  <input name=\"in2\" type=\"vector3\" nodename=\"tangent\"/>\n</crossproduct>\n"
        "<normalize name=\"normalmap_bitangent\" type=\"vector3\">\n  <input name=\"in\" "
        "type=\"vector3\" nodename=\"normalmap_cross\"/>\n</normalize>\n"
        "<normalmap name=\"n\" type=\"vector3\">\n  <input name=\"normal\" type=\"vector3\" "
        "nodename=\"i\"/>\n"
        "  <input name=\"bitangent\" type=\"vector3\" "
        "nodename=\"normalmap_bitangent\"/>\n</normalmap>\n");
}

/* One node that selects channels: what it is now, `rest` of its tag and its children. */
static void require_swizzle(const char *from, const char *to, const char *channels,
                            const char *expected)
{
    char text[512];
    snprintf(text, sizeof text,
             "<swizzle name=\"s\" type=\"%s\" nodedef=\"ND\"><input name=\"in\" type=\"%s\" %s/>"
             "<input name=\"channels\" type=\"string\" value=\"%s\"/></swizzle>",
             to, from, strchr(from, '"') ? "" : "nodename=\"n\"", channels);
    require_upgrade("1.38", text, expected);
}

static void test_channels(void)
{
    require_swizzle("color3", "float", "g",
                    "<extract name=\"s\" type=\"float\">\n  <input name=\"in\" type=\"color3\" "
                    "nodename=\"n\"/>\n"
                    "  <input name=\"index\" type=\"integer\" value=\"1\"/>\n</extract>\n");
    require_swizzle("color4", "color3", "rgb",
                    "<convert name=\"s\" type=\"color3\">\n  <input name=\"in\" type=\"color4\" "
                    "nodename=\"n\"/>\n</convert>\n");
    require_swizzle("float", "color3", "rrr",
                    "<convert name=\"s\" type=\"color3\">\n  <input name=\"in\" type=\"float\" "
                    "nodename=\"n\"/>\n</convert>\n");
    require_swizzle("color3", "color3", "rgb",
                    "<dot name=\"s\" type=\"color3\">\n  <input name=\"in\" type=\"color3\" "
                    "nodename=\"n\"/>\n</dot>\n");
    require_swizzle("vector3", "vector2", "1y",
                    "<separate3 name=\"separate\" type=\"multioutput\">\n  <input name=\"in\" "
                    "type=\"vector3\" nodename=\"n\"/>\n</separate3>\n"
                    "<combine2 name=\"s\" type=\"vector2\">\n  <input name=\"in1\" type=\"float\" "
                    "value=\"1.0\"/>\n"
                    "  <input name=\"in2\" type=\"float\" nodename=\"separate\" "
                    "output=\"outy\"/>\n</combine2>\n");
    require_swizzle("float", "vector2", "0x",
                    "<combine2 name=\"s\" type=\"vector2\">\n  <input name=\"in1\" type=\"float\" "
                    "value=\"0.0\"/>\n"
                    "  <input name=\"in2\" type=\"float\" nodename=\"n\"/>\n</combine2>\n");
    require_swizzle("color3\" value=\"0.1, 0.2, 0.3", "color3", "bgr",
                    "<constant name=\"s\" type=\"color3\">\n  <input name=\"value\" "
                    "type=\"color3\" value=\"0.3, 0.2, 0.1\"/>\n</constant>\n");
    require_swizzle("color3", "vector2", "10",
                    "<constant name=\"s\" type=\"vector2\">\n  <input name=\"value\" "
                    "type=\"vector2\" value=\"1.0, 0.0\"/>\n</constant>\n");
    const char *port =
        "<image name=\"i\" type=\"color3\"/><nodegraph name=\"g\"><add name=\"a\" type=\"color3\"/>"
        "<output name=\"o\" type=\"float\" nodename=\"a\" channels=\"g\"/></nodegraph>";
    const char *changed =
        "<image name=\"i\" type=\"color3\"/>\n<nodegraph name=\"g\">\n  <add name=\"a\" "
        "type=\"color3\"/>\n"
        "  <extract name=\"channels\" type=\"float\">\n    <input name=\"in\" type=\"color3\" "
        "nodename=\"a\"/>\n"
        "    <input name=\"index\" type=\"integer\" value=\"1\"/>\n  </extract>\n"
        "  <output name=\"o\" type=\"float\" nodename=\"channels\"/>\n</nodegraph>\n";
    require_upgrade("1.38", port, changed);
    /* 1.39 has no channels, but ignoring them would show something else */
    require_upgrade("1.39", port, changed);
    require_upgrade("1.37",
                    "<image name=\"i\" type=\"color2\"/><a name=\"b\" type=\"float\"><input "
                    "name=\"c\" type=\"float\" nodename=\"i\" channels=\"a\"/></a>",
                    "<image name=\"i\" type=\"vector2\"/>\n"
                    "<extract name=\"channels\" type=\"float\">\n  <input name=\"in\" "
                    "type=\"vector2\" nodename=\"i\"/>\n"
                    "  <input name=\"index\" type=\"integer\" value=\"1\"/>\n</extract>\n"
                    "<a name=\"b\" type=\"float\">\n  <input name=\"c\" type=\"float\" "
                    "nodename=\"channels\"/>\n</a>\n");
    require_upgrade("1.38",
                    "<nodegraph name=\"g\"><output name=\"o\" type=\"color3\"/></nodegraph>"
                    "<a name=\"b\" type=\"float\"><input name=\"c\" type=\"float\" nodegraph=\"g\" "
                    "output=\"o\" channels=\"b\"/></a>",
                    "<nodegraph name=\"g\">\n  <output name=\"o\" type=\"color3\"/>\n</nodegraph>\n"
                    "<extract name=\"channels\" type=\"float\">\n  <input name=\"in\" "
                    "type=\"color3\" nodegraph=\"g\" output=\"o\"/>\n"
                    "  <input name=\"index\" type=\"integer\" value=\"2\"/>\n</extract>\n"
                    "<a name=\"b\" type=\"float\">\n  <input name=\"c\" type=\"float\" "
                    "nodename=\"channels\"/>\n</a>\n");
}

static void test_remarks(void)
{
    struct fixture f;
    fixture_read(&f,
                 "<materialx version=\"1.38\">\n<atan2 name=\"a\">\n<input "
                 "name=\"in1\"/></atan2></materialx>",
                 NULL);
    REQUIRE_EQ(f.diags.items.len, 1);
    REQUIRE_EQ(f.diags.items.items[0].id, DIAG_ID_upgraded);
    REQUIRE_EQ(f.diags.items.items[0].place.line, 3);
    REQUIRE_STR(f.diags.items.items[0].message, "1.39: input 'in1' is now 'iny'");
    fixture_close(&f);
}

/* Memory runs out at many different points of an upgrade: nothing leaks. */
static void test_memory(void)
{
    const char *text = "<materialx version=\"1.37\"><material name=\"M\"><shaderref name=\"S\" "
                       "node=\"s\"/></material>"
                       "<conductor_brdf name=\"a\"><input name=\"edge_color\"/></conductor_brdf>"
                       "<dielectric_brdf name=\"b\"><input name=\"base\" nodename=\"a\" "
                       "channels=\"r\"/></dielectric_brdf></materialx>";
    for (volatile size_t used = 0; used < 16 << 10; used += 64) {
        struct fixture f;
        fixture_init(&f);
        if (setjmp(f.trap.place) == 0) {
            for (size_t n = 0; n < used; n += 64)
                arena_alloc(&f.arena, 64);
            f.allocations_left = 1; /* for the reader's own arena */
            fixture_read_bytes(&f, text, strlen(text), NULL);
        }
        fixture_close(&f);
    }
}

int main(void)
{
    xml_startup();
    test_renames();
    test_always();
    test_structure();
    test_materials();
    test_closures();
    test_normalmaps();
    test_channels();
    test_remarks();
    test_memory();
    return test_report("upgrade");
}
