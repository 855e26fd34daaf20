// A shader of several files as one text that can be edited, and back: each file begins with a line that names it.
const marker = /^\/\/ file: (\S+)$/;

export const textOf = files => files.map(({name, text}) => `// file: ${name}\n${text.endsWith("\n") ? text : text + "\n"}`).join("");

/// [{name, text, line}]: `line` is that of the text which the file's first line is, from 1. What stands before the first name is "shader.wgsl".
export function filesOf(text) {
  const files = [{name: "shader.wgsl", lines: [], line: 1}];
  text.split("\n").forEach((line, k) => {
    const name = marker.exec(line)?.[1];
    if (name) files.push({name, lines: [], line: k + 2});
    else files[files.length - 1].lines.push(line);
  });
  if (files.length > 1 && files[0].lines.every(line => line.trim() === "")) files.shift();
  return files.map(({name, lines, line}) => ({name, text: lines.join("\n"), line}));
}

/// What a compiler complains of in the message of runCase: [{file, line, column, message, at}], `at` the line of the whole text.
export function errorsOf(message, files) {
  const found = [];
  // A compiler may begin its sentence on the next line.
  for (const [, name, line, column, sentence] of message.matchAll(/(?:^|\s)([^\s:]+):(\d+):(\d+):\s+(?:Shader '' parsing error: )?([^\n]*)/g)) {
    const file = files.find(f => f.name === name);
    if (file) found.push({file: name, line: Number(line), column: Number(column), message: sentence, at: file.line + Number(line) - 1});
  }
  return found;
}
