// node mistake_record.mjs < wrong.html > mistake.json: what the front page shows of the judged port with a mistake, from the report that
// `rainref validate --html` wrote.
import fs from "node:fs";

const html = fs.readFileSync(0, "utf8");
function dataOf(id) {
  const text = new RegExp(`<script type="application/json" id="${id}">(.*?)</script>`, "s").exec(html)?.[1];
  if (!text) throw new Error(`expected a report of rainref validate, found no ${id} in it`);
  return JSON.parse(text);
}
const {status, first_bad_pass: pass, passes} = dataOf("judgement"), bad = passes.find(p => p.pass === pass), cause = bad?.causes[0];
if (!cause?.is_likely || cause.line_texts.length !== 1) throw new Error(`expected a report with one likely cause at one line, found ${status} with ${bad?.causes.length ?? 0} causes`);
const {reference, port, difference, verdict} = dataOf("buffers").passes[passes.indexOf(bad)][0].views[0], {failing, invocations} = bad.figures;
process.stdout.write(JSON.stringify({status, pass, failing, invocations, cause: cause.name, sentence: `${cause.sentence.split(";")[0]}.`, line: cause.line_texts[0],
  shown: {reference, port, difference, verdict}}, null, 1) + "\n");
