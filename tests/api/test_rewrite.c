// SPDX-License-Identifier: Apache-2.0
/* mxg_rewrite: documents as text, formatted and upgraded. */
#include "edit_fixture.h"

static void test_rewrite(void)
{
    static const char old[] = "<?xml version='1.0'?>\n<!-- head -->\n"
                              "<materialx version='1.38'>\n\n\n"
                              "  <!-- an angle -->\n"
                              "  <atan2 type='float' name='a'> <!-- inside -->\n\n\n"
                              "    <input name='in1' type='float' value='1'/><!-- one -->\n"
                              "    <input name='in2' type='float' value='&lt;2'/>\n"
                              "    <!-- last -->\n"
                              "  </atan2>\n\n\n\n  <nodegraph name='g'><!-- none --></nodegraph>\n"
                              "</materialx>\n<!-- tail -->\n";
    static const char formatted[] =
        "<?xml version=\"1.0\"?>\n<!-- head -->\n<materialx version=\"1.38\">\n"
        "  <!-- an angle -->\n"
        "  <atan2 name=\"a\" type=\"float\">\n    <!-- inside -->\n\n"
        "    <input name=\"in1\" type=\"float\" value=\"1\"/> <!-- one -->\n"
        "    <input name=\"in2\" type=\"float\" value=\"&lt;2\"/>\n"
        "    <!-- last -->\n  </atan2>\n\n"
        "  <nodegraph name=\"g\">\n    <!-- none -->\n  </nodegraph>\n"
        "</materialx>\n<!-- tail -->\n";
    struct fixture f;
    open_fixture(&f);
    mxg_result *result = NULL;
    REQUIRE_EQ(mxg_rewrite(f.context, MXG_REWRITE_FORMAT, "a.mtlx", old, strlen(old), &result),
               MXG_OK);
    REQUIRE_STR(mxg_result_text(result, NULL), formatted);
    mxg_result_destroy(result);
    REQUIRE_EQ(mxg_rewrite(f.context, MXG_REWRITE_UPGRADE, "a.mtlx", old, strlen(old), &result),
               MXG_OK);
    const char *upgraded = mxg_result_text(result, NULL);
    REQUIRE(strstr(upgraded, "version=\"1.39\"") && strstr(upgraded, "<!-- one -->"));
    REQUIRE(strstr(upgraded, "name=\"iny\"") && !strstr(upgraded, "in1"));
    REQUIRE(has_diagnostic(mxg_result_diagnostics(result), "upgraded"));
    mxg_result_destroy(result);
    /* a file, whose include stays */
    REQUIRE_EQ(mxg_rewrite(f.context, MXG_REWRITE_FORMAT, "main.mtlx", NULL, 0, &result), MXG_OK);
    REQUIRE(strstr(mxg_result_text(result, NULL), "<xi:include href=\"tint.mtlx\"/>") != NULL);
    REQUIRE(strstr(mxg_result_text(result, NULL), "xmlns:xi=") != NULL);
    mxg_result_destroy(result);
    REQUIRE_EQ(mxg_rewrite(f.context, MXG_REWRITE_FORMAT, "none.mtlx", NULL, 0, &result),
               MXG_ERROR_DOCUMENT);
    REQUIRE(!mxg_result_text(result, NULL));
    REQUIRE(has_diagnostic(mxg_result_diagnostics(result), "file-missing"));
    mxg_result_destroy(result);
    REQUIRE_EQ(mxg_rewrite(f.context, (mxg_rewriting)2, "a", old, 3, &result), MXG_ERROR_ARGUMENT);
    REQUIRE_EQ(mxg_rewrite(f.context, MXG_REWRITE_FORMAT, "a", "<a", 2, &result),
               MXG_ERROR_DOCUMENT);
    mxg_result_destroy(result);
    close_fixture(&f);
}

int main(void)
{
    test_rewrite();
    return test_report("api-rewrite");
}
