# SPDX-License-Identifier: Apache-2.0
# The tests of `mxgen check` source this file. It makes documents, and queries JSON reports.

# material NAME [ROUGHNESS]: a document with a material
material() {
    cat <<END
<?xml version="1.0"?>
<materialx version="1.39">
  <standard_surface name="SR" type="surfaceshader">
    <input name="specular_roughness" type="float" value="${2:-0.5}"/>
  </standard_surface>
  <surfacematerial name="$1" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="SR"/>
  </surfacematerial>
</materialx>
END
}

# json FILE EXPRESSION: of r, the report, and d, its documents
json() {
    python3 -c '
import json, sys
report = json.load(open(sys.argv[1], encoding="utf-8"))
print(eval(sys.argv[2].strip(), {"r": report, "d": report["documents"]}))' "$@"
}

# is GOT EXPECTED
is() { [ "$1" = "$2" ] || { printf 'got "%s" instead of "%s"\n' "$1" "$2"; return 1; }; }

# says FILE EXPRESSION EXPECTED
says() { is "$(json "$1" "$2")" "$3"; }

uniforms='d[0]["elements"][0]["shaders"][0]["uniformBytes"]'

# validates SCHEMA FILE
validates() {
    python3 -c '
import json, sys, jsonschema
schema, report = (json.load(open(path, encoding="utf-8")) for path in sys.argv[1:])
jsonschema.Draft202012Validator.check_schema(schema)
jsonschema.Draft202012Validator(schema).validate(report)' "$@"
}
