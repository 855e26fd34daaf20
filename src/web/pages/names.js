// The names of the site's large files. As this file stands here they are the files' own. `scripts/web publish` puts names with a hash of the
// content here, so that a browser may keep such a file for ever.
const published = {};
/// The name to fetch a file of the site by.
export const publishedName = name => published[name] ?? name;
