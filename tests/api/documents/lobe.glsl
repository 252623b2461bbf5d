vec3 lobe_environment(vec3 color, vec3 V) { return color * (V * 0.5 + 0.5); }
