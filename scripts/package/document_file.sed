# For Doxygen: the comment that a header begins with is the file's.
1i /// @file
1,/^[^\/]/s,^//,///,
