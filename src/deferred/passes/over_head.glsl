// A surface over what a pixel stores.

ivec2 mx_over;          // the pixel at hand
bool mx_is_dry = false;  // words are counted, not written

// Writes a word behind the targets.
void mx_put_at(uint index, uint word)
{
    if (!mx_is_dry)
        imageStore(mx_words, ivec3(mx_over, int(index)), uvec4(word));
}

// Packed words are variables here, and images below.
#define mx_word0 mx_packed0
#define mx_word1 mx_packed1
#define mx_word2 mx_packed2
