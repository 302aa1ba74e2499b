# A fresh run against what the repository shows. `make publish` copies a run there.


rule compare_published:
    input:
        fresh=expand("results/tables/{table}.csv", table=PUBLISHED_TABLES),
        published=expand("results/published/tables/{table}.csv", table=PUBLISHED_TABLES),
    output:
        "results/tables/published_comparison.csv",
    log:
        "results/logs/compare_published.log",
    params:
        code=code_of("compare_published"),
        fresh=lambda wildcards, input: Path(input.fresh[0]).parent,
        published=lambda wildcards, input: Path(input.published[0]).parent,
    shell:
        "sedfiber compare_published --published {params.published} --fresh {params.fresh}"
        " -o {output} 2>&1 | tee {log}"
