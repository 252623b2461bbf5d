// The words of a pixel as results of a function.

uint mx_packed[MX_WORDS];

void mx_put_at(uint index, uint word)
{
    mx_packed[index + 3u] = word;
}

// Neighbours are unknown here, so glints are their mean.
vec2 mx_glint_extent(vec2 uv)
{
    return vec2(0.0);
}
