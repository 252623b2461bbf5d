
// Begins a pixel: no closure is stored. place: its middle, in pixels.
int mx_begin_words(vec2 place)
{
    mx_place = place;
    mx_word0 = 0u;
    mx_word1 = 0u;
    mx_word2 = 0u;
    for (int i = 0; i < MX_WORDS; ++i)
        mx_packed[i] = 0u;
#if MX_WORDS > 3
    mx_num_closures = 0u;
    mx_num_words = 0u;
    mx_is_special = false;
#endif
    return 0;
}

// A word, after mx_finish_closures, whose result is `finished`.
uint mx_packed_word(int finished, int index)
{
    return index == 0 ? mx_word0 : index == 1 ? mx_word1 : index == 2 ? mx_word2 : mx_packed[index];
}
