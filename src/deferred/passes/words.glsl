// The words of a pixel as results of a function.

uint mx_packed[MX_WORDS];

// Keeps a word behind the first three, which are variables.
void mx_put_at(uint index, uint word)
{
    mx_packed[index + 3u] = word;
}
